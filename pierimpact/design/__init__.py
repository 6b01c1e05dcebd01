"""The design procedure by closed formulas, from truck, pier and speed to the design reaction.

`procedure` has the formulas in their order; `domain` says what they were checked for, and `study`
how good they are; `reaction` is what callers use. `static_forces` says where shear and moment may
be taken from the reaction as a static force, by `static_study`. `band` says how sure a reaction is,
`beam_band` how sure the member forces of a beam are.
`codes` has the forces of design codes, `methods` the ways in which others calculate a collision.
"""
