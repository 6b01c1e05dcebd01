"""The collision as a moving picture: engine, body, crushing springs and deflecting pier."""

import math
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pierimpact.crush import CrushSpring
from pierimpact.teaching.chart import BLUE, GREY, INK, PALE, VERMILION, canvas, plain, text
from pierimpact.teaching.scenario import Strike, between
from pierimpact.units import printed

Array = NDArray[np.float64]

FRAMES = 201
WIDTH, HEIGHT = 720.0, 294.0
GROUND = 262.0
PIER_FACE = 410.0
SCALE = 41.0  # pixels a metre, in all but the pier's movement
TALLEST = 5.05  # of the column, above which it is cut off [m]
PAD = 5.0  # thickness of a spring crushed flat [px]
SWING = 24.0  # largest movement drawn of the pier [px]
CONCRETE, ASPHALT = "#c9c4bb", "#57606a"

# Heights above the road [m], and the body's silhouette; the model itself has all at one height.
ENGINE_HEIGHT, BODY_HEIGHT = 0.88, 2.1
ENGINE_LENGTH, BOX_LENGTH, BOX_BOTTOM, BOX_TOP = 1.0, 4.6, 1.22, 3.3


class Frame(NamedTuple):
    """What moves, at one instant [SI]."""

    time: float
    pier: float
    engine_crush: float
    body_crush: float
    engine_free: float
    body_free: float
    engine_force: float
    body_force: float
    engine_velocity: float
    body_velocity: float


class Animation:
    """The frames of one collision.

    Parameters
    ----------
    strike : Strike
        The collision.
    """

    def __init__(self, strike: Strike) -> None:
        self.strike = strike
        self.times = np.linspace(0.0, float(strike.history.time[-1]), FRAMES)
        for moment in _moments(strike):  # each has a frame of its own, to the instant
            self.times[self.index(moment)] = moment

    @cached_property
    def _frames(self) -> Array:
        history, truck = self.strike.history, self.strike.truck
        pier = between(history.time, history.pier_displacement, history.pier_velocity, self.times)
        series = [
            history.engine_crush,
            history.body_crush,
            _free_crush(truck.engine_spring, history.engine_crush),
            _free_crush(truck.body_spring, history.body_crush),
            history.engine_force,
            history.body_force,
            history.engine_velocity,
            history.body_velocity,
        ]
        others = (np.interp(self.times, history.time, samples) for samples in series)
        return np.array([self.times, pier, *others]).T

    @cached_property
    def exaggeration(self) -> float:
        """How many times larger the pier's movement is drawn, a round number."""
        largest = float(np.abs(self.strike.history.pier_displacement).max())
        raw = SWING / (SCALE * largest)
        unit = 10.0 ** math.floor(math.log10(raw))
        return max(unit * n for n in (1.0, 2.0, 5.0) if unit * n <= raw * 1.001)

    def index(self, time: float) -> int:
        """Return the frame nearest to a time [s]."""
        return int(np.argmin(np.abs(self.times - time)))

    def svg(self, index: int) -> str:
        """Draw one frame."""
        frame = Frame(*self._frames[index].tolist())
        shift = frame.pier * self.exaggeration * SCALE
        face = PIER_FACE + shift
        words = f"Collision after {printed(frame.time, 'time', 'SI')}: {self.phase(frame)}"
        return canvas(
            WIDTH,
            HEIGHT,
            f'<rect width="{WIDTH:g}" height="{HEIGHT:g}" fill="white"/>'
            f'<path d="M0 {GROUND:g}H{WIDTH:g}" stroke="{ASPHALT}" stroke-width="3"/>'
            + self._pier(shift)
            + self._truck(frame, face)
            + self._reaction(frame, shift)
            + text(8.0, 18.0, f"{1e3 * frame.time:.1f} ms", INK, 15, weight=600)
            + text(92.0, 18.0, self.phase(frame), INK, 13)
            + text(
                WIDTH - 8.0,
                HEIGHT - 6.0,
                f"pier’s movement drawn {plain(self.exaggeration)} times too large",
                GREY,
                10.5,
                "end",
            ),
            words,
        )

    def phase(self, frame: Frame) -> str:
        """Say what is going on at a frame."""
        history = self.strike.history
        engine, cargo = history.engine_contact_time, history.cargo_contact_time
        t = frame.time
        if frame.engine_force <= 0.0 and frame.body_force <= 0.0:
            return "First touch." if t == 0.0 else "The truck has let go: the pier swings freely."
        if cargo is not None and t >= cargo and frame.body_force > 0.0:
            return "The cargo is against the pier."
        if engine is not None and t >= engine and frame.engine_force > 0.0:
            return "The engine block is against the pier."
        if engine is not None and t >= engine:
            return "The engine is done; the body crumples on, and the pier rings."
        return "Sheet metal crumples: two plateau forces push the pier."

    def _truck(self, frame: Frame, face: float) -> str:
        engine, body = self.strike.truck.engine_spring, self.strike.truck.body_spring
        engine_front = face - _gap(engine, frame.engine_crush)
        box_front = face - _gap(body, frame.body_crush)
        # What has been crushed does not stretch again: after the rebound there is a gap.
        engine_tip = min(engine_front + _gap(engine, frame.engine_free), face)
        nose = min(box_front + _gap(body, frame.body_free), face)
        scale = SCALE
        box_left = box_front - BOX_LENGTH * scale
        top, bottom = _z(BOX_TOP), _z(BOX_BOTTOM)
        crumple = 1.0 - max(nose - box_front, 0.0) / (body.plateau_length * scale + PAD)
        engine_left = engine_front - ENGINE_LENGTH * scale
        return (
            # Chassis and rear wheels go with the body.
            f'<rect x="{box_left:.1f}" y="{_z(1.22):.1f}" width="{BOX_LENGTH * scale:.1f}" '
            f'height="9" fill="{ASPHALT}"/>'
            + _wheel(box_left + 1.15 * scale)
            + _cab(box_front, nose, crumple)
            + f'<rect x="{box_left:.1f}" y="{top:.1f}" width="{BOX_LENGTH * scale:.1f}" '
            f'height="{bottom - top:.1f}" rx="4" fill="#e3eff8" stroke="{BLUE}" stroke-width="2"/>'
            + text(
                (box_left + box_front) / 2.0,
                (top + bottom) / 2.0 - 5.0,
                f"m₂ {_mass(self.strike.truck.body_mass)}",
                BLUE,
                14,
                "middle",
                weight=600,
            )
            + text(
                (box_left + box_front) / 2.0,
                (top + bottom) / 2.0 + 14.0,
                f"{_speed(frame.body_velocity)}",
                BLUE,
                12.5,
                "middle",
            )
            + _zigzag(box_front, nose, _z(BODY_HEIGHT), BLUE, frame.body_force)
            + _wheel(engine_left + 0.1 * scale)
            + f'<rect x="{engine_left:.1f}" y="{_z(1.2):.1f}" width="{ENGINE_LENGTH * scale:.1f}" '
            f'height="{0.66 * scale:.1f}" rx="5" fill="{VERMILION}"/>'
            + text(
                engine_front - 0.5 * ENGINE_LENGTH * scale, _z(0.92), "m₁", "white", 13, "middle",
                weight=600,
            )
            + text(
                min(engine_front, PIER_FACE - 30.0),
                GROUND + 19.0,
                f"m₁ {_mass(self.strike.truck.engine_mass)}, {_speed(frame.engine_velocity)}",
                VERMILION,
                12.5,
                "end",
            )
            + _zigzag(engine_front, engine_tip, _z(ENGINE_HEIGHT), VERMILION, frame.engine_force)
        )  # fmt: skip

    def _pier(self, shift: float) -> str:
        column = self.strike.column
        if column is None:
            return self._oscillator(shift)
        height, width = column.column.height, column.column.section.diameter * SCALE  # type: ignore[union-attr]
        shown = min(height, TALLEST)
        z = np.linspace(0.0, shown, 25)
        x = PIER_FACE + shift * column.shape(z)
        y = GROUND - z * SCALE
        face = [f"{a:.1f} {b:.1f}" for a, b in zip(x, y, strict=True)]
        back = [f"{a:.1f} {b:.1f}" for a, b in zip(x + width, y, strict=True)][::-1]
        strikes = _z(column.impact_height)
        crown = float(y[-1])
        parts = (
            f'<path d="M{"L".join([*face, *back])}Z" fill="{CONCRETE}" stroke="{GREY}"/>'
            f'<path d="M{PIER_FACE + width / 2:.1f} {GROUND:g}V{crown:.1f}" stroke="{GREY}" '
            f'stroke-dasharray="2 4"/>'
            f'<path d="M{x[0] + width + 6:.1f} {strikes:.1f}h10" stroke="{GREY}"/>'
        )
        parts += _end(column.column.base, float(x[0]), width, GROUND, 1.0)
        if height <= TALLEST:
            parts += _end(column.column.top, float(x[-1]), width, crown, -1.0)
        else:
            parts += text(
                float(x[-1]) + width + 8.0, crown + 12.0, f"↑ up to {height:.3g} m", GREY, 11
            )
        return parts

    def _oscillator(self, shift: float) -> str:
        """Draw the pier as what it is in the model: a mass on a spring and a damper."""
        left, top, bottom = PIER_FACE + shift, _z(3.0), _z(0.35)
        wall, side = PIER_FACE + 170.0, 62.0
        spring, damper = top + 34.0, bottom - 26.0
        middle = (left + side + wall) / 2.0
        return (
            f'<rect x="{left:.1f}" y="{top:.1f}" width="{side:g}" height="{bottom - top:.1f}" '
            f'rx="4" fill="{CONCRETE}" stroke="{GREY}"/>'
            + text(left + side / 2.0, (top + bottom) / 2.0 + 4.0, "m_p", INK, 14, "middle",
                   weight=600)
            + _zigzag(left + side, wall, spring, INK, 0.0)
            + text(middle, spring - 12.0, "k_p", INK, 12, "middle")
            + f'<path d="M{left + side:.1f} {damper:.1f}H{middle:.1f}m0 -7v14M{middle + 12:.1f} '
            f'{damper - 10:.1f}H{middle - 10:.1f}m0 20H{middle + 12:.1f}v-20M{middle + 12:.1f} '
            f'{damper:.1f}H{wall:g}" fill="none" stroke="{INK}" stroke-width="1.6"/>'
            + text(middle, damper - 15.0, "c_p", INK, 12, "middle")
            + f'<rect x="{wall:g}" y="{top - 12:.1f}" width="9" height="{GROUND - top + 12:.1f}" '
            f'fill="{GREY}"/>'
        )  # fmt: skip

    def _reaction(self, frame: Frame, shift: float) -> str:
        """Draw the reaction as an arrow that holds against the pier, to scale."""
        strike, column = self.strike, self.strike.column
        value = strike.pier.stiffness * frame.pier
        largest = float(np.abs(strike.history.reaction).max())
        length = 90.0 * abs(value) / largest
        width = 62.0 if column is None else column.column.section.diameter * SCALE  # type: ignore[union-attr]
        y = _z(2.05) if column is None else max(_z(column.impact_height), _z(TALLEST))
        tip = PIER_FACE + shift + width + 6.0
        words = text(
            tip + 6.0 if column is not None else tip,
            y - 12.0 if column is not None else _z(3.35),
            f"R = {printed(value, 'force', 'SI')}",
            INK,
            13,
            weight=600,
        )
        if length < 4.0 or column is None:
            return words
        tail = tip + length
        start, end, barb = (tail, tip, 7.0) if value > 0.0 else (tip, tail, -7.0)
        return words + (
            f'<path d="M{start:.1f} {y:.1f}H{end + barb:.1f}" stroke="{INK}" stroke-width="3.5"/>'
            f'<path d="M{end:.1f} {y:.1f}l{1.4 * barb:.1f} -5.5v11z" fill="{INK}"/>'
        )


def _moments(strike: Strike) -> list[float]:
    """Return the instants of the contacts and peaks [s]."""
    history = strike.history
    peaks = (history.engine_peak, history.cargo_peak)
    moments = [history.engine_contact_time, history.cargo_contact_time]
    moments += [peak.time for peak in peaks if peak is not None]
    return [moment for moment in moments if moment is not None]


def _free_crush(spring: CrushSpring, crush: Array) -> Array:
    """Return the crush that stays when a spring is let go, at each sample of its crush."""
    largest = np.maximum.accumulate(crush)
    left: Array = np.maximum(largest - spring.envelope(largest) / spring.unloading_stiffness, 0.0)
    return np.maximum(crush, left)


def _gap(spring: CrushSpring, crush: float) -> float:
    """Return the length drawn of what is left of a spring [px]."""
    return max(spring.plateau_length - crush, 0.0) * SCALE + PAD


def _z(height: float) -> float:
    """Return where a height above the road is drawn [px]."""
    return GROUND - height * SCALE


def _mass(value: float) -> str:
    return str(printed(value, "mass", "SI", given=True))


def _speed(velocity: float) -> str:
    kmh = 3.6 * velocity
    return f"{0.0 if abs(kmh) < 0.05 else kmh:.1f} km/h".replace("-", "−")


def _wheel(x: float) -> str:
    y = GROUND - 0.44 * SCALE
    return (
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{0.44 * SCALE:.1f}" fill="{INK}"/>'
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{0.2 * SCALE:.1f}" fill="{PALE}"/>'
    )


def _cab(rear: float, nose: float, crumple: float) -> str:
    """Draw bonnet and cab between the cargo and the nose; they fold as they shorten."""
    length = nose - rear

    def points(outline: list[tuple[float, float]]) -> str:
        return "L".join(f"{rear + length * along:.1f} {_z(z):.1f}" for along, z in outline)

    # Folds along the bonnet grow as it shortens.
    fold = 0.16 * max(crumple, 0.0)
    bonnet = [
        (0.42 + 0.58 * n / 8.0, 1.62 - 0.12 * n / 8.0 + (fold if n % 2 else -fold) * (0 < n < 8))
        for n in range(9)
    ]
    outline = [(0.0, 2.75), (0.2, 2.75), *bonnet, (1.0, 0.72), (0.93, 0.55), (0.0, 0.75)]
    window = [(0.05, 2.6), (0.19, 2.6), (0.36, 1.78), (0.05, 1.78)]
    return (
        f'<path d="M{points(outline)}Z" fill="#f3f6f9" fill-opacity="0.9" stroke="{GREY}" '
        f'stroke-width="1.6" stroke-linejoin="round"/>'
        f'<path d="M{points(window)}Z" fill="#cfe3f2" stroke="{GREY}" stroke-width="1"/>'
    )


def _zigzag(start: float, end: float, y: float, colour: str, force: float) -> str:
    """Draw a spring; it is thicker while it presses."""
    turns, half = 7, 7.0
    step = (end - start) / turns
    path = f"M{start:.1f} {y:.1f}"
    flank = f"l{0.25 * step:.2f} {-half:g}"
    path += turns * f"{flank}l{0.5 * step:.2f} {2 * half:g}{flank}"
    width = 1.6 if force <= 0.0 else 2.8
    return (
        f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="{width:g}" '
        f'stroke-linejoin="round"/>'
        f'<path d="M{end:.1f} {y - 9:.1f}v18" stroke="{colour}" stroke-width="{width:g}"/>'
    )


def _end(kind: str, x: float, width: float, y: float, down: float) -> str:
    """Draw what holds an end: a block, a hinge in a block, or nothing."""
    if kind == "free":
        return ""
    middle, block = x + width / 2.0, 15.0
    hinge = 0.0
    parts = ""
    if kind == "pinned":
        hinge = 6.0
        parts = (
            f'<circle cx="{middle:.1f}" cy="{y + down * 3:.1f}" r="4" fill="white" '
            f'stroke="{INK}" stroke-width="1.6"/>'
        )
    top = y + down * hinge if down > 0 else y - hinge - block
    return parts + (
        f'<rect x="{middle - width / 2 - 26:.1f}" y="{top:.1f}" width="{width + 52:.1f}" '
        f'height="{block:g}" fill="{GREY}" fill-opacity="0.55"/>'
    )
