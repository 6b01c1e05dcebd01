"""The collision by the coupled mass-spring-damper (CMSD) model, propagated exactly.

`parameters` holds what strikes what; `regimes` the equations of motion and their changes, and
`yielding` those of a pier that yields; `coasting` covers uncoupled motion in closed form;
`stepping` sums coupled motion as a Taylor series and ends each step at the first change of regime,
which `series` locates; `ringing` follows a fast vibration for many cycles at once; `propagation`
takes one collision to its end, or many side by side, which `groups` keeps; `beam` does so with the
modes of a beam, and `beams` for many trucks at a time by small steps, to a per cent.
Callers use `simulate`.
"""
