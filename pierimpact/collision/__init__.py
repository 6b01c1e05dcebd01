"""The collision by the coupled mass-spring-damper (CMSD) model, propagated exactly.

`parameters` holds what strikes what; `regimes` the equations of motion and their changes, and
`yielding` those of a pier that yields; `coasting` covers uncoupled motion in closed form;
`stepping` sums coupled motion as a Taylor series and ends each step at the first change of regime,
which `series` locates; `beam` does so with the modes of a beam; `groups` keeps many collisions
side by side. Callers use `simulate`.
"""
