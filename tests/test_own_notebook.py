"""A case in a user's own notebook: results as a table, and figures of matplotlib."""

import math
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from matplotlib.figure import Figure

from pierimpact import InputError
from pierimpact.files.case import read_case_file
from pierimpact.plots.figures import figure_of
from pierimpact.plots.svg import to_svg
from pierimpact.report.calculation import calculate
from pierimpact.report.results import Results
from pierimpact.report.sheet import Sheet

CASE = read_case_file(Path(__file__).parents[1] / "notebooks" / "tti-column.yaml").case


@pytest.fixture(scope="module")
def sheet():
    return Sheet(CASE)


def test_table_has_the_results(sheet):
    frame = sheet.calculation.to_dataframe()
    results = Results.of(sheet.calculation)
    band = dict(zip(("band_low", "band_high"), results.band, strict=True))
    for name in ("shear", "moment"):
        band[f"{name}_high"] = results.member_bands[name][1]
        band[f"{name}_utilisation"] = results.utilisations.get(name)
        band[f"upper_{name}_utilisation"] = results.upper_utilisations.get(name)
    for name, value in frame["value"].items():
        expected = (results.model_dump() | band)[name]
        assert value == expected or (math.isnan(value) and expected is None)
    assert frame.loc["design_reaction", "unit"] == "N"


def test_table_of_a_calculation_without_pandas(sheet, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ModuleNotFoundError, match="to_dataframe needs pandas: pip install pandas"):
        sheet.calculation.to_dataframe()


def test_a_slow_truck_leaves_nan_for_the_cargo():
    slow = replace(CASE, inputs=CASE.inputs.model_copy(update={"speed": 5.0}))
    frame = calculate(slow).to_dataframe()
    assert math.isnan(frame.loc["cargo_peak", "value"])


@pytest.mark.parametrize(
    ("heading", "block"),
    [("first_page", "verdict"), ("inputs", "crush_curves"), ("model", "history"),
     ("spectrum_method", "spectra"), ("member_forces", "diagrams"), ("codes", "bars"),
     ("sensitivity", "tornado")],
)  # fmt: skip
def test_figure_of_a_block_is_what_the_block_shows(sheet, heading, block):
    draw = getattr(getattr(sheet, heading), block)
    figure = figure_of(draw)
    assert isinstance(figure, Figure)
    assert figure.axes
    assert to_svg(figure).startswith("<?xml")


def test_what_draws_nothing_is_refused(sheet):
    with pytest.raises(InputError, match="draw must draw a figure, got peaks"):
        figure_of(sheet.model.peaks)
