"""The validation notebook, and the tables and figures that it shows."""

import json
import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import papermill
import pytest

from pierimpact import cargo_spectrum, engine_spectrum, load_truck
from pierimpact.design import study
from pierimpact.design.reaction import predictions
from pierimpact.plots import validation as spectrum_figures
from pierimpact.report.validation import Validation, routes, unified_spectrum

NOTEBOOK = Path(__file__).parents[1] / "notebooks" / "validation.ipynb"
TRUCK = load_truck("single-unit-8t")
TRACTOR_TRAILER = load_truck("tractor-trailer-36t")


@pytest.fixture(scope="module")
def validation():
    return Validation(size=400, seed=8)


def numbers(table):
    """Return the rows of a table as numbers by heading."""
    headings = [column.heading for column in table.columns]
    return {
        row[0]: {
            heading: float(cell.replace("−", "-"))
            for heading, cell in zip(headings[1:], row[1:], strict=True)
            if re.fullmatch(r"[−\d.]+", cell)
        }
        for row in table.rows
    }


def test_the_notebook_runs_on_a_copy(tmp_path):
    output = tmp_path / "validation.ipynb"
    papermill.execute_notebook(
        NOTEBOOK, output, kernel_name="python3", progress_bar=False, log_output=False
    )
    cells = json.loads(output.read_text(encoding="utf-8"))["cells"]
    code = [cell for cell in cells if cell["cell_type"] == "code"]
    shown = [
        output["data"]["text/html"]
        for cell in code
        for output in cell["outputs"]
        if "text/html" in output.get("data", {})
    ]
    assert len(shown) == len(code) - 1  # all but the imports
    assert 'alt="Scatter plot of 6000 collisions' in "".join(map("".join, shown))


def test_the_notebook_is_on_cases_that_were_not_fitted():
    assert Validation().size >= 5000
    assert Validation().seed != study.SEED


@pytest.mark.parametrize("level", ["long", "short"])
@pytest.mark.parametrize("which", ["engine", "cargo", "governing"])
def test_tables_by_band(validation, level, which):
    case, exact = validation._case, validation._exact
    predicted = predictions(case, level)
    ratios = getattr(predicted, which) / getattr(exact, which)
    ratios = ratios[np.isfinite(ratios)]
    table = numbers(validation.bands(level, which))
    assert table["All"]["Cases"] == len(ratios)
    assert table["All"]["Mean"] == pytest.approx(ratios.mean(), abs=6e-4)
    assert table["All"]["1st percentile"] == pytest.approx(np.quantile(ratios, 0.01), abs=6e-4)
    assert sum(row["Cases"] for name, row in table.items() if name != "All") == len(ratios)


def test_a_band_without_cases_shows_no_numbers():
    few = Validation(size=3, seed=0)
    rows = few.bands("short", "cargo").rows
    empty = [row for row in rows if row[1] == "0"]
    assert empty
    assert all(set(row[2:]) == {"–"} for row in empty)


def test_other_tables(validation):
    limits = numbers(validation.domain_table())
    assert limits["Speed at first touch"] == {"From": 50.0, "To": 110.0}
    spectrum = numbers(validation.spectrum())
    assert 1.0 < spectrum["Engine"]["Mean"] < 1.1
    speeds = numbers(validation.contact_speeds())
    assert set(speeds) == {"Engine, long", "Cargo, long", "Engine, short", "Cargo, short"}
    assert abs(speeds["Engine, long"]["Mean"]) < 0.05


def test_tables_outside_the_domain(validation):
    trucks = numbers(validation.trucks([TRUCK.loaded_to(36e3), TRACTOR_TRAILER]))
    assert list(trucks) == [
        "single-unit-8t, 36 t, short",
        "single-unit-8t, 36 t, long",
        "tractor-trailer-36t, 36.3 t, short",
        "tractor-trailer-36t, 36.3 t, long",
    ]
    for row in trucks.values():
        assert 0.95 < row["Mean"] < 1.1
    # What the notebook's prose says of each.
    beyond = numbers(validation.beyond())
    assert beyond["Pier frequency 3–5 Hz, long"]["Mean"] > 1.1
    assert beyond["Damping 0–2 %, short"]["1st percentile"] < 0.88
    assert beyond["Damping 0–2 %, long"]["1st percentile"] > 0.9
    assert beyond["Damping 7–20 %, long"]["1st percentile"] > 0.93
    assert beyond["Body plateau length reduced to a quarter, long"]["1st percentile"] < 0.8
    for speed in ("30–50", "110–160"):
        assert 0.98 < beyond[f"Speed {speed} km/h, long"]["Mean"] < 1.06


# Figures


def drawings():
    validation = Validation(size=60, seed=1)
    engine, cargo = (
        spectrum(TRUCK, 22.0, 2e4, frequency=np.geomspace(5.0, 100.0, 20))
        for spectrum in (engine_spectrum, cargo_spectrum)
    )
    return {
        "amplification": spectrum_figures.draw_amplification([0.02, 1.0], 0.4, 0.05),
        "routes": spectrum_figures.draw_routes(engine, cargo, "US"),
        "scatter": validation.scatter("short").svg,
        "ratios": validation.ratios("long").svg,
    }


def test_figures_are_the_same_bytes_every_time_and_whole_in_themselves():
    first, second = drawings(), drawings()
    assert first == second
    for name, svg in first.items():
        root = ElementTree.fromstring(svg)
        assert root.tag.endswith("svg"), name
        links = re.findall(r'href="([^"]{0,20})', svg)
        assert all(link.startswith(("#", "data:")) for link in links), name
        assert "<text" not in svg, name  # text is drawn as outlines


def test_alternative_texts_say_what_there_is_to_see(validation):
    assert "400 collisions" in validation.scatter("long").alt
    ratio = study.summary(
        predictions(validation._case, "long").governing / validation._exact.governing
    )
    assert f"{ratio['mean']:.3f} times" in validation.ratios("long").alt
    figure = routes(TRUCK, 80 / 3.6, 20e3)
    highest = np.nanmax(cargo_spectrum(TRUCK, 80 / 3.6, 20e3).full_model)
    assert f"cargo {highest / 1e6:.2f} MN" in figure.alt
    assert unified_spectrum([0.1], 0.4, 0.05).alt


def test_a_spectrum_without_contact_can_be_drawn():
    figure = routes(TRUCK, 6.0, 20e3)
    assert "cargo" not in figure.alt.partition(":")[2]
