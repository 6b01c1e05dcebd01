"""What the keys of a case file mean, in words, for the template and for the schema."""

from typing import get_args

from pydantic import BaseModel

from pierimpact.files.inputs import Inputs, StepInputs
from pierimpact.files.limits import ends_in
from pierimpact.files.plausible import USUAL, USUAL_MODULI
from pierimpact.symbols import BY_KEY, dimension
from pierimpact.units import DIMENSIONS

# The meanings of keys that stand for no quantity, and of some that say more than the table of
# symbols does.
_WORDS = {
    "office": "name of the office",
    "logo": "image file of the office’s logo (PNG, JPEG or SVG), from the folder of this file",
    "project": "project",
    "prepared_by": "who prepared the calculation",
    "checked_by": "who checked it",
    "approved_by": "who approved it",
    "units": "units that the sheet prints in, whatever its values are given in",
    "job_number": "job number, in quotes if it is a number",
    "element": "part of the structure",
    "revision": "revision, in quotes if it is a number",
    "date": "date; if left out, that of its line in the table of revisions, or today’s",
    "column_shape": "shape of the column’s section",
    "base": "what holds the base of the column",
    "top": "what holds its top",
    "steps": "changes of the section, from the base upward: the height of each and its section, "
    "and its shear_resistance and moment_resistance if they are not those below",
    "height": "height above the base from which the section or a resistance is another",
    "truck": "truck of the catalogue, or a truck file of your own (.toml)",
    "member_forces": "member forces that are checked: the larger of both methods, those of the "
    "column as a beam, or those of the static reaction",
    "weigh_in_motion": "CSV file of weighed trucks, mass and perhaps speed, from the folder of "
    "this file; in place of traffic_mass",
    "traffic_trucks": "trucks of the traffic, each for the masses that it stands for; this case’s "
    "and those of the catalogue if left out",
    "assumed": "keys whose values no source gives, each with the reason for its value",
    "sources": "where the values of keys are from",
    "notes": "notes of your own, printed with the inputs",
    "revisions": "table of revisions on the first page",
    "description": "what changed",
    "by": "who made the revision",
    "supersedes": "case file of the revision before, from the folder of this file",
    "annexes": "annexes of the sheet: all, or a list of them",
}
# What the meanings in the table of symbols leave unsaid.
_MORE = {
    "concrete_strength": "or else elastic_modulus",
    "elastic_modulus": "in place of concrete_strength",
    "stiffness_factor": "or else effective_stiffness",
    "effective_stiffness": "in place of stiffness_factor",
    "impact_height": "or auto: both heights of the rule, the larger reaction governs",
    "truck_mass": "if it is not that of the truck file",
    "traffic_volume": "on the lanes from which vehicles may come to it; for `pierimpact risk`, as "
    "are those that follow",
    "exposed_width": "2.5 m of JCSS if left out",
    "encroachment_rate": "1e-10 1/vehicle/m of JCSS if left out",
    "traffic_mass": "a distribution of scipy.stats, such as lognorm(s=0.5, scale=18 t), or "
    "normal(mean=20 t, sd=12 t) from 3.5 t; that of JCSS if left out",
    "traffic_speed": "a distribution, or a class of road of JCSS: motorway, urban or courtyard; "
    "motorway if left out",
    "traffic_deceleration": "a distribution; that of JCSS if left out",
    "traffic_angle": "a distribution; that of JCSS if left out",
    "shear_resistance": "without it shear is not checked",
    "moment_resistance": "without it moment is not checked",
}
# What they leave unsaid of a step's.
_MORE_OF_STEP = dict.fromkeys(
    ("shear_resistance", "moment_resistance"), "that of the part below if left out"
)


def explanation(key: str, model: type[BaseModel] = Inputs) -> str:
    """Return in a line what a key means, what its value may be, and what it is if left out.

    Parameters
    ----------
    key : str
        Name of a field of the model.
    model : type, optional
        The inputs, or those of a step or of a revision.
    """
    field, kind = model.model_fields[key], quantity_of(key)
    choices = [str(choice) for choice in get_args(field.annotation) if isinstance(choice, str)]
    default = str(field.default) if isinstance(field.default, str | float) else ""
    notes = [
        ", ".join(choices),
        DIMENSIONS[kind].units if kind else "",
        f"{default} if left out" if default.strip("—") else "",
    ]
    words = _WORDS[key] if key in _WORDS else BY_KEY[key].meaning
    in_brackets = "; ".join(filter(None, notes))
    unsaid = _MORE | (_MORE_OF_STEP if model is StepInputs else {})
    more = f"; {unsaid[key]}" if key in unsaid else ""
    return f"{words} ({in_brackets}){more}" if in_brackets else f"{words}{more}"


def quantity_of(key: str) -> str:
    """Return the dimension of a key's value, of `units.DIMENSIONS`; "" for a number or a word."""
    if key == "height":  # of a step
        return "length"
    return dimension(BY_KEY[key]) if key in BY_KEY else ""


def usual_for(key: str, system: str) -> str:
    """Return what is usual for a key's value, such as "2.0 to 30 m"; "" where nothing is known.

    Parameters
    ----------
    key : str
        Key of a case file.
    system : {"SI", "US"}
        Units to print in.
    """
    ranges = [USUAL[key]] if key in USUAL else []
    if key == "elastic_modulus":
        ranges = list(USUAL_MODULI.values())
    return " or ".join(ends_in(BY_KEY[key].quantity, ends, system) for ends in ranges)
