"""The collision as a picture: engine, body, crushing springs and deflecting pier."""

from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyBboxPatch, Polygon, Rectangle

from pierimpact.pier.column import StruckColumn
from pierimpact.plots.style import BLUE, INK, MUTED, PALE, PIXEL, VERMILION
from pierimpact.units import printed
from pierimpact.vehicle.truck import Truck

# All in metres, to scale but for the pier's movement: x from the pier's face in the direction of
# travel, z above the road. The model itself has all at one height.
_LEFT, _RIGHT, _BOTTOM, _TOP = -9.0, 7.3, -0.72, 5.75
#: Size of the picture [px].
SIZE = (720.0, 720.0 * (_TOP - _BOTTOM) / (_RIGHT - _LEFT))
#: Largest movement drawn of the pier [m].
SWING = 0.6
_TALLEST = 5.1  # of the column, above which it is cut off
_PAD = 0.12  # thickness of a spring crushed flat
_ENGINE_HEIGHT, _BODY_HEIGHT = 0.88, 2.1
_ENGINE_LENGTH, _BOX_LENGTH, _BOX_BOTTOM, _BOX_TOP = 1.0, 4.6, 1.22, 3.3
_BLOCK, _WALL, _WHEEL, _ARROW = 1.5, 4.1, 0.44, 2.2
_CONCRETE, _ASPHALT, _GLASS, _SHEET_METAL, _CARGO = (
    "#c9c4bb", "#57606a", "#cfe3f2", "#f3f6f9", "#e3eff8",
)  # fmt: skip


class Scene(NamedTuple):
    """What stays in the picture of one collision.

    Parameters
    ----------
    truck : Truck
        The truck.
    column : StruckColumn or None
        The column; None where the pier is drawn as what it is in the model, a mass on a spring.
    exaggeration : float
        How many times larger the pier's movement is drawn [-].
    largest : float
        Largest reaction of the collision, for the length of its arrow [N].
    """

    truck: Truck
    column: StruckColumn | None
    exaggeration: float
    largest: float

    @property
    def depth(self) -> float:
        """Extent of the pier in the direction of travel [m]."""
        if self.column is None:
            return _BLOCK
        return self.column.column.section.extent


class Frame(NamedTuple):
    """What moves in the picture, at one instant.

    Parameters
    ----------
    time : float
        Time after first touch [s].
    pier : float
        Displacement of the pier [m].
    reaction : float
        Reaction [N].
    engine_crush, body_crush : float
        Crush of the springs [m].
    engine_free, body_free : float
        The crush at which they would be without force: what has been crushed does not stretch
        again [m].
    engine_force, body_force : float
        Their forces [N].
    engine_velocity, body_velocity : float
        Velocities [m/s].
    """

    time: float
    pier: float
    reaction: float
    engine_crush: float
    body_crush: float
    engine_free: float
    body_free: float
    engine_force: float
    body_force: float
    engine_velocity: float
    body_velocity: float


def picture(figure: Figure) -> Axes:
    """Return the axes of the picture."""
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    axes.set(xlim=(_LEFT, _RIGHT), ylim=(_BOTTOM, _TOP), aspect="equal")
    return axes


def draw_scene(axes: Axes, scene: Scene) -> None:
    """Draw what does not move: the road, what holds the pier, and the scale of its movement."""
    axes.plot([_LEFT, _RIGHT], [0.0, 0.0], color=_ASPHALT, linewidth=3.0 * PIXEL)
    words = f"pier’s movement drawn {scene.exaggeration:g} times too large"
    axes.text(_RIGHT - 0.15, _BOTTOM + 0.12, words, ha="right", color=MUTED)
    if scene.column is None:
        axes.add_artist(Rectangle((_WALL, 0.0), 0.22, 3.3, color=MUTED))
        return
    column, depth = scene.column.column, scene.depth
    _draw_support(axes, column.base, depth, 0.0, -1.0)
    if column.height <= _TALLEST:
        _draw_support(axes, column.top, depth, column.height, 1.0)
    else:
        words = f"↑ up to {column.height:.3g} m"
        axes.text(depth + SWING + 0.2, _TALLEST - 0.3, words, color=MUTED)
    top = min(column.height, _TALLEST)
    axes.plot([0.5 * depth, 0.5 * depth], [0.0, top], ":", color=MUTED, linewidth=PIXEL)


def draw_frame(axes: Axes, scene: Scene, frame: Frame) -> None:
    """Draw what moves, at one instant."""
    shift = frame.pier * scene.exaggeration
    if scene.column is None:
        _draw_oscillator(axes, shift)
    else:
        _draw_column(axes, scene.column, scene.depth, shift)
    _draw_truck(axes, scene.truck, frame, shift)
    _draw_reaction(axes, scene, frame.reaction, shift)


def _draw_column(axes: Axes, column: StruckColumn, depth: float, shift: float) -> None:
    z = np.linspace(0.0, min(column.column.height, _TALLEST), 25)
    x = shift * column.shape(z)
    outline = np.array([np.append(x, x[::-1] + depth), np.append(z, z[::-1])]).T
    edge: Any = {"edgecolor": MUTED, "linewidth": PIXEL, "zorder": 0.9}
    axes.add_artist(Polygon(outline, facecolor=_CONCRETE, **edge))


def _draw_oscillator(axes: Axes, shift: float) -> None:
    """Draw the pier as what it is in the model: a mass on a spring and a damper."""
    right, middle = shift + _BLOCK, 0.5 * (shift + _BLOCK + _WALL)
    _box(axes, shift, 0.35, _BLOCK, 2.65, _CONCRETE, MUTED)
    _name(axes, shift + 0.5 * _BLOCK, 1.67, "$m_\\mathrm{p}$", INK, 14.0)
    _draw_spring(axes, right, _WALL, 2.3, INK, 1.6)
    _name(axes, middle, 2.6, "$k_\\mathrm{p}$", INK, 13.0)
    for x, z in (
        ([right, middle], [0.95, 0.95]),
        ([middle, middle], [0.8, 1.1]),
        ([middle + 0.3, middle - 0.25, middle - 0.25, middle + 0.3], [0.72, 0.72, 1.18, 1.18]),
        ([middle + 0.3, middle + 0.3], [0.72, 1.18]),
        ([middle + 0.3, _WALL], [0.95, 0.95]),
    ):
        axes.plot(x, z, color=INK, linewidth=1.6 * PIXEL)
    _name(axes, middle, 1.27, "$c_\\mathrm{p}$", INK, 13.0)


def _draw_truck(axes: Axes, truck: Truck, frame: Frame, face: float) -> None:
    engine, body = truck.engine_spring.plateau_length, truck.body_spring.plateau_length
    engine_front = face - _gap(engine, frame.engine_crush)
    box_front = face - _gap(body, frame.body_crush)
    # After the rebound there is a gap before the pier.
    engine_tip = min(engine_front + _gap(engine, frame.engine_free), face)
    nose = min(box_front + _gap(body, frame.body_free), face)
    box = box_front - _BOX_LENGTH
    axes.add_artist(Rectangle((box, 1.0), _BOX_LENGTH, 0.22, color=_ASPHALT))  # the chassis
    _draw_wheel(axes, box + 1.15)
    _draw_cab(axes, box_front, nose, body + _PAD)
    _box(axes, box, _BOX_BOTTOM, _BOX_LENGTH, _BOX_TOP - _BOX_BOTTOM, _CARGO, BLUE)
    centre = box + 0.5 * _BOX_LENGTH
    _name(axes, centre, 2.25, f"m₂ {_mass(truck.body_mass)}", BLUE, 14.0)
    _name(axes, centre, 1.82, _speed(frame.body_velocity), BLUE, 12.5, weight="normal")
    _draw_spring(axes, box_front, nose, _BODY_HEIGHT, BLUE, _stroke(frame.body_force))
    _draw_wheel(axes, engine_front - _ENGINE_LENGTH + 0.1)
    _box(axes, engine_front - _ENGINE_LENGTH, 0.54, _ENGINE_LENGTH, 0.66, VERMILION, VERMILION)
    _name(axes, engine_front - 0.5 * _ENGINE_LENGTH, 0.78, "m₁", "white", 13.0)
    words = f"m₁ {_mass(truck.engine_mass)}, {_speed(frame.engine_velocity)}"
    place = min(engine_front, -0.7), -0.5
    axes.text(*place, words, ha="right", color=VERMILION, fontsize=12.5 * PIXEL)
    stroke = _stroke(frame.engine_force)
    _draw_spring(axes, engine_front, engine_tip, _ENGINE_HEIGHT, VERMILION, stroke)


def _draw_cab(axes: Axes, rear: float, nose: float, whole: float) -> None:
    """Draw bonnet and cab between the cargo and the nose; they fold as they shorten."""
    length = nose - rear
    fold = 0.16 * max(1.0 - length / whole, 0.0)
    along = np.linspace(0.42, 1.0, 9)
    bonnet = 1.62 - 0.12 * np.linspace(0.0, 1.0, 9)
    bonnet[1:-1] += fold * np.where(np.arange(7) % 2, -1.0, 1.0)
    outline = [(0.0, 2.75), (0.2, 2.75), *zip(along, bonnet, strict=True), (1.0, 0.72),
               (0.93, 0.55), (0.0, 0.75)]  # fmt: skip
    window = [(0.05, 2.6), (0.19, 2.6), (0.36, 1.78), (0.05, 1.78)]
    for points, colour in ((outline, _SHEET_METAL), (window, _GLASS)):
        corners = np.array(points) * (length, 1.0) + (rear, 0.0)
        line: Any = {"edgecolor": MUTED, "linewidth": 1.4 * PIXEL, "joinstyle": "round"}
        axes.add_artist(Polygon(corners, facecolor=colour, **line))


def _draw_spring(
    axes: Axes, start: float, end: float, z: float, colour: str, stroke: float
) -> None:
    """Draw a spring as a zigzag, with a plate at its end."""
    quarters = np.arange(4 * 7 + 1)  # of its seven turns
    heights = 0.17 * np.array([0.0, 1.0, 0.0, -1.0])[quarters % 4]
    line: Any = {"color": colour, "linewidth": stroke * PIXEL}
    axes.plot(start + (end - start) / quarters[-1] * quarters, z + heights, **line)
    axes.plot([end, end], [z - 0.22, z + 0.22], **line)


def _draw_reaction(axes: Axes, scene: Scene, reaction: float, shift: float) -> None:
    """Draw the reaction as an arrow that holds against the pier, to scale."""
    tip = shift + scene.depth + 0.15
    z = 3.45 if scene.column is None else min(scene.column.impact_height, _TALLEST)
    words = f"R = {printed(reaction, 'force', 'SI')}"
    axes.text(tip + 0.1, z + 0.2, words, fontsize=13.0 * PIXEL, fontweight="bold")
    length = _ARROW * abs(reaction) / scene.largest
    if scene.column is None or length < 0.1:
        return
    near, far = (tip, z), (tip + length, z)
    end, start = (near, far) if reaction > 0.0 else (far, near)
    arrow = {
        "arrowstyle": "-|>,head_width=0.25,head_length=0.5",
        "color": INK,
        "linewidth": 3.0 * PIXEL,
        "shrinkA": 0.0,
        "shrinkB": 0.0,
    }
    axes.annotate("", end, xytext=start, arrowprops=arrow)


def _draw_wheel(axes: Axes, x: float) -> None:
    for radius, colour in ((_WHEEL, INK), (0.45 * _WHEEL, PALE)):
        axes.add_artist(Circle((x, _WHEEL), radius, color=colour))


def _draw_support(axes: Axes, kind: str, depth: float, z: float, outwards: float) -> None:
    """Draw what holds an end: a block, a hinge in a block, or nothing."""
    if kind == "free":
        return
    hinge = 0.15 if kind == "pinned" else 0.0
    if hinge:
        pin: Any = {"facecolor": "white", "edgecolor": INK, "linewidth": 1.6 * PIXEL, "zorder": 2.0}
        axes.add_artist(Circle((0.5 * depth, z + outwards * 0.5 * hinge), 0.09, **pin))
    corner = -0.6, z + outwards * hinge
    axes.add_artist(Rectangle(corner, depth + 1.2, outwards * 0.36, color="#b4bac0"))


def _box(axes: Axes, x: float, z: float, width: float, height: float, face: str, edge: str) -> None:
    style = "round,pad=0,rounding_size=0.1"
    colours: Any = {"facecolor": face, "edgecolor": edge, "linewidth": 1.8 * PIXEL}
    axes.add_artist(FancyBboxPatch((x, z), width, height, boxstyle=style, **colours))


def _name(
    axes: Axes, x: float, z: float, words: str, colour: str, size: float, weight: str = "bold"
) -> None:
    axes.text(x, z, words, ha="center", color=colour, fontsize=size * PIXEL, weight=weight)


def _gap(length: float, crush: float) -> float:
    """Return the length drawn of what is left of a spring [m]."""
    return max(length - crush, 0.0) + _PAD


def _stroke(force: float) -> float:
    """Return the width of a spring's line; it is thicker while it presses [px]."""
    return 2.8 if force > 0.0 else 1.6


def _mass(value: float) -> str:
    return str(printed(value, "mass", "SI", given=True))


def _speed(velocity: float) -> str:
    kmh = 3.6 * velocity
    return f"{0.0 if abs(kmh) < 0.05 else kmh:.1f} km/h".replace("-", "−")
