"""A column under a unit force at the impact height, for each pair of ends.

The deflection under a unit force, the shape function and its integral (Eqs 1–3 of the source
paper), by the force method of beam theory with flexure and shear. Derived here. What each symbol
stands for is in `pierimpact.symbols`, how the lines are printed in `pierimpact.handcalc`. Moments
are per unit of force; the shape below and above the impact is a polynomial in s, the distance
from the base or from the top over the height of the column.

Forces and moments of the far end are written out, as the difference of 1 and a number close to it
would lose them where the impact is close to an end, and the far shape with them.
"""

from pierimpact.handcalc import Calculation


def propped(z, y, H, EI, GA):
    """Return the forces where one end is fixed, and the other, pinned, is released and put back.

    The impact is z from the fixed and y from the pinned end. Deflections of the released end,
    forces at the pinned and the fixed end, moments at the fixed end and at the impact.
    """
    delta10 = z**2 * (2 * H + y) / (6 * EI) + z / GA  # flexure and shear
    delta11 = H**3 / (3 * EI) + H / GA  # flexure and shear
    Rp = delta10 / delta11  # no displacement at the released end
    Rf = 1 / delta11 * (y * (3 * H**2 - y**2) / (6 * EI) + y / GA)  # equilibrium: both add up to 1
    Mf = -z * y * H * (H + y) / (6 * EI * delta11)  # equilibrium
    Mn = Rp * y  # equilibrium
    return delta10, delta11, Rp, Rf, Mf, Mn


def guided(z, y, H, EI, GA):
    """Return the deflection of an end that moves but does not rotate; the other end is fixed."""
    return z**2 * (H + 2 * y) / (12 * EI) + z / GA


def clamping(z, y, H, EI, GA, delta11):
    """Return the moment at the fixed end that is y from the impact; the other end is fixed too."""
    return -z * y / delta11 * (z * H / (12 * EI) + 1 / (2 * GA))


def stiffness(Rb, Rt, Mb, Mn, Mt, H, z, y, EI, GA):
    """Return the deflection at the impact, the stiffness, and where on the column the impact is.

    The deflection is twice the work of the unit force: the integrals of the squares of moment and
    shear, which change linearly or not at all between base, impact and top.
    """
    xfb = z * (Mb**2 + Mb * Mn + Mn**2) / (3 * EI)  # integral of M² over EI
    xft = y * (Mn**2 + Mn * Mt + Mt**2) / (3 * EI)  # integral of M² over EI
    xs = (z * Rb**2 + y * Rt**2) / GA  # integral of the squared shear over κGA
    xn = xfb + xft + xs
    kp = 1 / xn  # Eq. 3 of the source paper
    sb = z / H
    st = y / H
    return xfb, xft, xs, xn, kp, sb, st


def fixed_end(M, R, H, EI, GA, xn):
    """Return the coefficients of s², s³ and s beside a fixed end."""
    c2 = -M * H**2 / (2 * EI * xn)  # moment at the end
    c3 = -R * H**3 / (6 * EI * xn)  # force at the end
    c1 = R * H / (GA * xn)  # shear strain at the fixed end
    return c2, c3, c1


def pinned_end(R, s, H, EI, xn):
    """Return the coefficients of s³ and s beside a pinned end."""
    c3 = -R * H**3 / (6 * EI * xn)  # force at the end
    c1 = (1 - c3 * s**3) / s  # φ = 1 at the impact
    return c3, c1


def free_end(s, other_s, other_c2, other_c3):
    """Return the coefficient of s and the constant beside a free end."""
    c1 = (
        -2 * other_c2 * other_s - 3 * other_c3 * other_s**2
    )  # rotation of the section continuous at the impact
    c0 = 1 - c1 * s  # φ = 1 at the impact
    return c1, c0


def integral_cubic(H, s, c1, c2, c3):
    """Return the integral of φ² beside a fixed end."""
    return H * (
        c1**2 * s**3 / 3
        + c1 * c2 * s**4 / 2
        + (c2**2 + 2 * c1 * c3) * s**5 / 5
        + c2 * c3 * s**6 / 3
        + c3**2 * s**7 / 7
    )


def integral_odd(H, s, c1, c3):
    """Return the integral of φ² beside a pinned end."""
    return H * (c1**2 * s**3 / 3 + 2 * c1 * c3 * s**5 / 5 + c3**2 * s**7 / 7)


def integral_straight(H, s, c0, c1):
    """Return the integral of φ² beside a free end."""
    return H * (c0**2 * s + c0 * c1 * s**2 + c1**2 * s**3 / 3)


@Calculation
def fixed_free(H, z, y, EI, GA):
    """A cantilever from the base."""
    Rt = 0  # free top
    Mt = 0  # free top
    Rb = 1  # equilibrium
    Mb = -z  # equilibrium
    Mn = 0  # free above the impact
    xfb, xft, xs, xn, kp, sb, st = stiffness(Rb, Rt, Mb, Mn, Mt, H, z, y, EI, GA)
    cb2, cb3, cb1 = fixed_end(Mb, Rb, H, EI, GA, xn)
    ct1, ct0 = free_end(st, sb, cb2, cb3)
    phi2b = integral_cubic(H, sb, cb1, cb2, cb3)
    phi2t = integral_straight(H, st, ct0, ct1)
    return locals()


@Calculation
def free_fixed(H, z, y, EI, GA):
    """A cantilever from the top."""
    Rb = 0  # free base
    Mb = 0  # free base
    Rt = 1  # equilibrium
    Mt = -y  # equilibrium
    Mn = 0  # free below the impact
    xfb, xft, xs, xn, kp, sb, st = stiffness(Rb, Rt, Mb, Mn, Mt, H, z, y, EI, GA)
    ct2, ct3, ct1 = fixed_end(Mt, Rt, H, EI, GA, xn)
    cb1, cb0 = free_end(sb, st, ct2, ct3)
    phi2b = integral_straight(H, sb, cb0, cb1)
    phi2t = integral_cubic(H, st, ct1, ct2, ct3)
    return locals()


@Calculation
def pinned_pinned(H, z, y, EI, GA):
    """A simply supported column."""
    Rt = z / H  # equilibrium
    Rb = y / H  # equilibrium
    Mt = 0  # pinned top
    Mb = 0  # pinned base
    Mn = Rt * y  # equilibrium
    xfb, xft, xs, xn, kp, sb, st = stiffness(Rb, Rt, Mb, Mn, Mt, H, z, y, EI, GA)
    cb3, cb1 = pinned_end(Rb, sb, H, EI, xn)
    ct3, ct1 = pinned_end(Rt, st, H, EI, xn)
    phi2b = integral_odd(H, sb, cb1, cb3)
    phi2t = integral_odd(H, st, ct1, ct3)
    return locals()


@Calculation
def fixed_pinned(H, z, y, EI, GA):
    """A column propped at the top: the top is released, and brought back by its force."""
    delta10, delta11, Rt, Rb, Mb, Mn = propped(z, y, H, EI, GA)
    Mt = 0  # pinned top
    xfb, xft, xs, xn, kp, sb, st = stiffness(Rb, Rt, Mb, Mn, Mt, H, z, y, EI, GA)
    cb2, cb3, cb1 = fixed_end(Mb, Rb, H, EI, GA, xn)
    ct3, ct1 = pinned_end(Rt, st, H, EI, xn)
    phi2b = integral_cubic(H, sb, cb1, cb2, cb3)
    phi2t = integral_odd(H, st, ct1, ct3)
    return locals()


@Calculation
def pinned_fixed(H, z, y, EI, GA):
    """A column propped at the base: the base is released, and brought back by its force."""
    delta10, delta11, Rb, Rt, Mt, Mn = propped(y, z, H, EI, GA)
    Mb = 0  # pinned base
    xfb, xft, xs, xn, kp, sb, st = stiffness(Rb, Rt, Mb, Mn, Mt, H, z, y, EI, GA)
    cb3, cb1 = pinned_end(Rb, sb, H, EI, xn)
    ct2, ct3, ct1 = fixed_end(Mt, Rt, H, EI, GA, xn)
    phi2b = integral_odd(H, sb, cb1, cb3)
    phi2t = integral_cubic(H, st, ct1, ct2, ct3)
    return locals()


@Calculation
def fixed_fixed(H, z, y, EI, GA):
    """Both ends fixed: the top may move but not rotate, and is brought back by its force."""
    delta10 = guided(z, y, H, EI, GA)  # flexure and shear; the released end does not rotate
    delta11 = H**3 / (12 * EI) + H / GA  # flexure and shear; the released end does not rotate
    Rt = delta10 / delta11  # no displacement at the released end
    Rb = 1 / delta11 * guided(y, z, H, EI, GA)  # equilibrium: both add up to 1
    Mt = clamping(z, y, H, EI, GA, delta11)  # no rotation at the top
    Mb = clamping(y, z, H, EI, GA, delta11)  # equilibrium
    Mn = Mb + Rb * z  # equilibrium
    xfb, xft, xs, xn, kp, sb, st = stiffness(Rb, Rt, Mb, Mn, Mt, H, z, y, EI, GA)
    cb2, cb3, cb1 = fixed_end(Mb, Rb, H, EI, GA, xn)
    ct2, ct3, ct1 = fixed_end(Mt, Rt, H, EI, GA, xn)
    phi2b = integral_cubic(H, sb, cb1, cb2, cb3)
    phi2t = integral_cubic(H, st, ct1, ct2, ct3)
    return locals()


#: By the conditions of base and top; any other pair leaves the column a mechanism.
BY_ENDS = {
    ("fixed", "fixed"): fixed_fixed,
    ("fixed", "free"): fixed_free,
    ("fixed", "pinned"): fixed_pinned,
    ("free", "fixed"): free_fixed,
    ("pinned", "fixed"): pinned_fixed,
    ("pinned", "pinned"): pinned_pinned,
}
