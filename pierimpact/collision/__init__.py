"""The collision by the coupled mass-spring-damper (CMSD) model, propagated exactly.

`regimes` says what holds between two changes and what a change brings; `coasting` passes the
time in which nothing is coupled in closed form; `stepping` sums the coupled motion as its Taylor
series and ends each step at the first change; `series` finds where that is; `groups` holds many
collisions side by side. `simulate` is what callers use.
"""
