"""Taylor series over one step, and where a quantity summed from them first rises above zero.

The step is the unit of time: term k is the k-th derivative times h^k, so that the value at a
fraction θ of the step is Σ terms[k] θ^k/k!, and its rate the same sum from one term further on.

A number is a float for one collision, or an array of shape (n,) for n collisions side by side;
terms are a list of floats, or an array of shape (terms, n). The same lines serve both, with the
few functions that differ handed in as `ops`.
"""

import math
from collections.abc import Callable, Sequence
from functools import partial
from itertools import accumulate, repeat
from operator import mul
from typing import Any, NamedTuple, TypeAlias

import numpy as np

Real: TypeAlias = Any  # a float, or an array of shape (n,)
Flag: TypeAlias = Any  # a bool, or an array of shape (n,)
Terms: TypeAlias = Any  # a list of floats, or an array of shape (terms, n)

# Numerical settings.
TERMS = 30
PHASE = 3.0  # largest ω h of a step [rad]; the first term left out is PHASE**28/28! = 8e-17
PARTS = 2  # of a step; in each, the curvature of a quantity changes its sign at most once
NEVER = 2.0  # a fraction beyond the step
FACTORIALS = np.array([math.factorial(k) for k in range(TERMS)], dtype=float)[:, None]
RECIPROCALS = [1.0 / k for k in range(1, TERMS)]


class EventFunction(NamedTuple):
    """A quantity whose rise above zero ends a regime: level + Σ weight × a motion's derivative."""

    event: int
    order: int  # of the derivative
    parts: tuple[tuple[Real, int], ...]  # weights, and which of the motions
    level: Real


Rise: TypeAlias = tuple[int, Real, Flag]  # event, fraction of the step, whether it happens there


class Ops(NamedTuple):
    """What differs between floats and arrays."""

    lib: Any  # the module with sqrt, sin, …
    where: Callable[[Flag, Real, Real], Real]
    negate: Callable[[Flag], Flag]
    some: Callable[[Flag], bool]
    among: Callable[..., Real]  # what a function finds of those flagged, and a default of others
    sizes: Callable[[Terms], Terms]
    terms: Callable[[Real], int]  # of a step that is a part of the longest
    blank: Callable[[Real, int], Any]  # three series to fill in
    weights: Callable[[Real, int], Terms]  # θ^k/k!
    dot: Callable[[Terms, Terms], Real]  # Σ weights × terms
    fixed: Callable[[list[float], Terms], Real]  # the same, with one set of weights for all
    rises: Callable[[list[tuple[EventFunction, Flag]], Sequence[Terms]], list[Rise]]


def weights_of_one(theta: float, count: int = TERMS) -> list[float]:
    """Return θ^k/k! for one fraction, k < count."""
    return list(accumulate(map(mul, repeat(theta, count - 1), RECIPROCALS), mul, initial=1.0))


def weights_of_all(theta: Real, count: int = TERMS) -> Terms:
    """Return θ^k/k! for fractions of shape (n,), shape (count, n)."""
    powers = np.empty((count, len(theta)))
    powers[0] = 1.0
    power, known = theta, 1
    while known < count:  # the powers known, times θ^known, are as many more
        more = min(known, count - known)
        np.multiply(powers[:more], power, out=powers[known : known + more])
        power, known = power * power, known + more
    powers /= FACTORIALS[:count]
    return powers


def dot_of_all(weights: Terms, terms: Terms) -> Real:
    """Return Σ weights × terms, shape (n,), each the same to the last bit whatever the others."""
    if terms.shape[1] == 1:  # alone, they would be added up in another order
        return dot_of_all(np.repeat(weights, 2, axis=-1), np.repeat(terms, 2, axis=1))[:1]
    return np.einsum("kn,kn->n", weights[: len(terms)], terms)


def fixed_of_all(weights: list[float], terms: Terms) -> Real:
    """Return the same, with one set of weights for all."""
    if terms.shape[1] == 1:
        return fixed_of_all(weights, np.repeat(terms, 2, axis=1))[:1]
    return np.einsum("k,kn->n", weights[: len(terms)], terms)


def terms_needed(part: float) -> int:
    """Return how many terms a step takes that is a part of the longest."""
    return 10 + math.ceil(20.0 * math.sqrt(part))  # numerical; TERMS for a whole one


def among_all(flag: Flag, default: Real, find: Callable[..., Real], *given: Any) -> Real:
    """Return what `find` says of the terms and numbers given where flagged, else the default."""
    places = np.flatnonzero(flag)
    if len(places) == len(flag):
        return find(*given)
    found = default.copy()
    if len(places):
        flagged = (each.take(places, axis=-1) if np.ndim(each) else each for each in given)
        found[places] = find(*flagged)
    return found


NODES = [weights_of_one(part / PARTS) for part in range(PARTS + 1)]
END = NODES[PARTS]

CROSSES, ARCHES, DIPS, CRESTS = range(1, 5)


def first_suspect(terms: Terms, ops: Ops) -> tuple[Flag, Real, Real, Real]:
    """Find the first part of the step in which a quantity may rise above zero.

    Returns
    -------
    due : Flag
        Whether it is above zero at the start and does not return at once.
    part : Real
        The fraction at which the part begins, or NEVER.
    shape : Real
        CROSSES: from below to above. The others begin and may end below: ARCHES turns from
        rising to falling with a curvature of one sign; DIPS and CRESTS change their curvature
        from negative to positive and back.
    guess : Real
        Where in the part it crosses.
    """
    where, negate, fixed, some = ops.where, ops.negate, ops.fixed, ops.some
    width = 1.0 / PARTS
    rates, bends = terms[1:], terms[2:]
    f1, r1 = fixed(END, terms), fixed(END, rates)
    part, shape, guess = NEVER + 0.0 * f1, 0.0 * f1, 0.0 * f1
    for number in reversed(range(PARTS)):
        start, end = NODES[number], NODES[number + 1]
        f, r = (fixed(start, terms), fixed(start, rates)) if number else (terms[0], terms[1])
        below, ends_above = f <= 0.0, f1 > 0.0
        suspect = below & ends_above
        part, shape = where(suspect, number * width, part), where(suspect, CROSSES, shape)
        if some(suspect):
            crossing = number * width + width * crossing_of(
                f, f1, r * width, r1 * width, suspect, ops
            )
            guess = where(suspect, crossing, guess)
        # A curve that falls at the end, or rises at the start, does so nowhere faster as long
        # as it is bent down there: it can be above zero in between only if its tangent is.
        near = below & (
            ((r > 0.0) & (f + r * width > 0.0)) | ((r1 < 0.0) & (f1 - r1 * width > 0.0))
        )
        if some(near):
            c, c1 = fixed(start, bends), fixed(end, bends)
            meets = f * (r - r1) + r * (f1 - f - r1 * width) > 0.0
            arches = near & negate(ends_above) & (r > 0.0) & (r1 < 0.0) & meets
            dips = near & (c < 0.0) & (c1 > 0.0) & (r > 0.0)
            crests = near & negate(ends_above) & (c > 0.0) & (c1 < 0.0) & (r1 < 0.0)
            bent = where(dips, DIPS, where(crests, CRESTS, ARCHES))
            part = where(arches | dips | crests, number * width, part)
            shape = where(arches | dips | crests, bent, shape)
        due = negate(below) & ((r > 0.0) | ends_above)
        f1, r1 = f, r
    return due, part, shape, guess


def crossing_of(f: Real, f1: Real, r: Real, r1: Real, rises: Flag, ops: Ops) -> Real:
    """Return about where a quantity crosses zero between 0 and 1, from values and rates there.

    The place as a cubic of the quantity, with these ends; the middle where that leads astray.
    """
    where = ops.where
    regular = rises & (r > 0.0) & (r1 > 0.0)
    change = where(regular, f1 - f, 1.0)
    s = -f / change
    slope, slope1 = change / where(regular, r, 1.0), change / where(regular, r1, 1.0)
    place = s * s * (3.0 - 2.0 * s) + s * (1.0 - s) * ((1.0 - s) * slope - s * slope1)
    return where(regular & (place > 0.0) & (place < 1.0), place, 0.5)


def locate(terms: Terms, part: Real, shape: Real, guess: Real, ops: Ops) -> tuple[Real, Flag]:
    """Find where a quantity rises above zero in a suspect part.

    Returns
    -------
    theta : Real
        The fraction of the step; the end of the part where it stays below zero.
    happens : Flag
        Whether it rises above zero there.
    """
    where, among, at = ops.where, ops.among, partial(sum_at, ops=ops)
    end = part + 1.0 / PARTS
    crosses = happens = shape == CROSSES
    high, turning = end, ops.negate(happens)
    if ops.some(turning):
        rates, bends, nothing = terms[1:], terms[2:], 0.0 * end
        dips, crests = shape == DIPS, shape == CRESTS
        ends_above = among(turning, nothing, at, terms, end) > 0.0
        left, right, bent = part, end, dips | crests
        if ops.some(bent):
            bend = rise(bends, where(dips, 1.0, -1.0), where(bent, part, end), end, ops)
            rate = among(bent, nothing, at, rates, bend)
            left, right = where(crests, bend, part), where(dips, bend, end)
            turning = turning & where(dips, rate < 0.0, where(crests, rate > 0.0, True))
        top = rise(rates, -1.0, where(turning, left, right), right, ops)
        over = among(turning, nothing, at, terms, top) > 0.0
        high = where(over, top, end)
        happens = happens | over | ends_above
    theta = rise(terms, 1.0, where(happens, part, high), high, ops, where(crosses, guess, NEVER))
    return theta, happens


def sum_at(terms: Terms, theta: Real, ops: Ops) -> Real:
    """Return the sum at a fraction of the step."""
    return ops.dot(ops.weights(theta, len(terms)), terms)


def rise(terms: Terms, sign: Real, low: Real, high: Real, ops: Ops, guess: Real = NEVER) -> Real:
    """Return where sign × the sum rises through zero between `low` and `high`.

    Halley's method from a guess or the middle, with bisection where it would leave the bracket;
    `high` where the bracket is empty.
    """
    closer = partial(_closer, ops=ops, left=60)  # numerical
    start = ops.where(guess < high, guess, 0.5 * (low + high))
    return ops.among(low < high, high, closer, terms, sign, start, low, high)


def _closer(
    terms: Terms, sign: Real, theta: Real, low: Real, high: Real, *, ops: Ops, left: int
) -> Real:
    """Return the zero next to `theta`, after so many more steps at most."""
    where, dot = ops.where, ops.dot
    weights = ops.weights(theta, len(terms))
    f = sign * dot(weights, terms)
    r, c = sign * dot(weights, terms[1:]), sign * dot(weights, terms[2:])
    below = f <= 0.0
    low, high = where(below, theta, low), where(below, high, theta)
    denominator = 2.0 * r * r - f * c
    regular = (r > 0.0) & (denominator > 0.0)
    new = theta - where(regular, 2.0 * f * r / where(regular, denominator, 1.0), 1.0)
    regular = regular & (new >= low) & (new <= high)
    new = where(regular, new, 0.5 * (low + high))
    # The error that is left is of the order of the third power of the change.
    moves = abs(new - theta) > where(regular, 1e-5, 1e-15)
    closer = partial(_closer, ops=ops, left=left - 1)
    return ops.among(moves & (left > 1), new, closer, terms, sign, new, low, high)


def rises_of_one(flagged: list[tuple[EventFunction, Flag]], series: Sequence[Terms]) -> list[Rise]:
    """Return the first rises above zero of the flagged functions of one collision."""
    found: list[Rise] = []
    width = len(series[0]) - 2
    for (event, order, parts, level), flag in flagged:
        if not flag:
            continue
        weighted = [
            map(mul, repeat(weight), series[which][order : order + width])
            for weight, which in parts
        ]
        terms = list(map(sum, zip(*weighted, strict=True)) if len(parts) > 1 else weighted[0])
        terms[0] = _at_start(terms[0] + level, terms[1], FLOATS)
        due, part, shape, guess = first_suspect(terms, FLOATS)
        if due:
            found.append((event, 0.0, True))
        elif part < NEVER:
            found.append((event, *locate(terms, part, shape, guess, FLOATS)))
    return found


def rises_of_all(flagged: list[tuple[EventFunction, Flag]], series: Sequence[Terms]) -> list[Rise]:
    """Return the first rises above zero of the flagged functions of n collisions."""
    # The flagged functions of all collisions are searched together.
    groups = [(function, np.flatnonzero(flag)) for function, flag in flagged]
    groups = [(function, indices) for function, indices in groups if len(indices)]
    if not groups:
        return []
    terms = np.concatenate(
        [_gather(function, indices, series) for function, indices in groups], axis=1
    )
    due, part, shape, guess = first_suspect(terms, ARRAYS)
    theta, happens = np.where(due, 0.0, NEVER), due
    suspect = np.flatnonzero((part < NEVER) & ~due)
    if len(suspect):
        theta[suspect], happens[suspect] = locate(
            terms.take(suspect, axis=1), part[suspect], shape[suspect], guess[suspect], ARRAYS
        )
    found: list[Rise] = []
    first, size = 0, len(flagged[0][1])
    for function, indices in groups:
        mine = slice(first, first + len(indices))
        first = mine.stop
        fraction, certain = np.full(size, NEVER), np.zeros(size, dtype=bool)
        fraction[indices], certain[indices] = theta[mine], happens[mine]
        found.append((function.event, fraction, certain))
    return found


def _gather(function: EventFunction, indices: Any, series: Sequence[Terms]) -> Terms:
    width = len(series[0]) - 2
    weighted = [
        weight[indices]
        * series[which][function.order : function.order + width].take(indices, axis=1)
        for weight, which in function.parts
    ]
    terms = sum(weighted[1:], start=weighted[0])
    terms[0] = _at_start(terms[0] + function.level[indices], terms[1], ARRAYS)
    return terms


def _at_start(value: Real, rate: Real, ops: Ops) -> Real:
    """Return what a quantity starts from: zero where it is above but for round-off, and falls."""
    return ops.where((value > 0.0) & (rate < 0.0), 0.0, value)


FLOATS = Ops(
    lib=math,
    where=lambda flag, yes, no: yes if flag else no,
    negate=lambda flag: not flag,
    some=bool,
    among=lambda flag, default, find, *given: find(*given) if flag else default,
    sizes=lambda terms: list(map(abs, terms)),
    terms=terms_needed,
    blank=lambda like, count: ([0.0] * count, [0.0] * count, [0.0] * count),
    weights=weights_of_one,
    dot=lambda weights, terms: sum(map(mul, weights, terms)),
    fixed=lambda weights, terms: sum(map(mul, weights, terms)),
    rises=rises_of_one,
)
ARRAYS = Ops(
    lib=np,
    where=np.where,
    negate=np.logical_not,
    some=np.count_nonzero,
    among=among_all,
    sizes=np.abs,
    terms=lambda part: TERMS,  # whatever the others need
    blank=lambda like, count: np.empty((3, count, len(like))),
    weights=weights_of_all,
    dot=dot_of_all,
    fixed=fixed_of_all,
    rises=rises_of_all,
)
