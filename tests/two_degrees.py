"""One mass on a steep spring against the pier, integrated in small steps."""

import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar


def amplification(beta, mu, e, zeta):
    """Return the peak reaction for m_i = k_i = v_i = 1, one smooth piece after the other."""
    pier_mass, stiffness = 1.0 / mu, beta**2 / mu
    damping = 2.0 * zeta * math.sqrt(stiffness * pier_mass)
    slope, largest = 1.0 / e**2, 0.0
    time, state, regime = 0.0, [0.0, 1.0, 0.0, 0.0], "loading"
    end, peak = 15.0 + 2.0 * math.pi / beta, 0.0
    while time < end:
        released = largest * (1.0 - 1.0 / slope)

        def force(crush, regime=regime, released=released):
            if regime == "loading":
                return crush
            return 0.0 if regime == "free" else slope * (crush - released)

        def rates(t, y, force=force):
            x, v, xp, vp = y
            f = force(x - xp)
            return [v, -f, vp, (f - damping * vp - stiffness * xp) / pier_mass]

        def rate(t, y):
            return y[1] - y[3]

        def meets(t, y, released=released):
            return y[0] - y[2] - released

        def exceeds(t, y, largest=largest):
            return y[0] - y[2] - largest

        changes = {
            "loading": [(rate, -1, "back")],
            "back": [(meets, -1, "free"), (rate, 1, "again")],
            "again": [(exceeds, 1, "loading"), (rate, -1, "back")],
            "free": [(meets, 1, "again")],
        }[regime]
        for function, direction, _ in changes:
            function.terminal, function.direction = True, direction
        run = solve_ivp(
            rates,
            (time, end),
            state,
            "DOP853",
            events=[function for function, _, _ in changes],
            rtol=1e-11,
            atol=1e-13,
            max_step=0.3 * min(1.0, 1.0 / beta),
            dense_output=True,
        )
        peak = max(peak, _highest(run))
        time, state = run.t[-1], run.y[:, -1]
        if regime == "loading":
            largest = state[0] - state[2]
        fired = [to for (_, _, to), at in zip(changes, run.t_events, strict=True) if len(at)]
        regime = fired[0] if fired else regime
    return stiffness * peak


def _highest(run):
    t = np.linspace(run.t[0], run.t[-1], 1000)
    x = run.sol(t)[2]
    i = int(np.argmax(x))
    near = (t[max(i - 1, 0)], t[min(i + 1, len(t) - 1)])
    found = minimize_scalar(
        lambda s: -run.sol(s)[2], bounds=near, method="bounded", options={"xatol": 1e-12}
    )
    return max(x[i], -found.fun)
