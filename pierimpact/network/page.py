"""The summary page of a portfolio: one HTML file that asks nothing of any network."""

import base64
import hashlib
import json
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

import pierimpact
from pierimpact.design.quick_band import SIZE
from pierimpact.network.portfolio import BEAM, Portfolio
from pierimpact.network.tables import RESULTS, ResultColumn
from pierimpact.plots.portfolio import draw_distributions, draw_map
from pierimpact.resources import shipped
from pierimpact.units import rounded, unit_of, unit_size

#: Rows that the page lists at most, the worst: more make it slow to open. This project's choice.
LISTED = 100_000
#: Columns that it lists, in order; the others are in the files.
SHOWN = (
    *(
        "rank",
        "id",
        "warnings",
        "utilisation",
        "utilisation_high",
        "design_reaction",
        "band_low",
        "band_high",
    ),
    *("code_ratio", "largest_shear", "shear_method", "utilisation_shear"),
    *("largest_moment", "moment_method", "utilisation_moment", "truck", "truck_mass", "speed"),
    *("pier_frequency", "average_25ms", "latitude", "longitude"),
)
#: Quantiles of the table, by their heading: this project's choice.
QUANTILES = {"5 %": 0.05, "median": 0.5, "95 %": 0.95, "99 %": 0.99, "largest": 1.0}
_OF_THE_TABLE = {
    "design_reaction": "Design reaction",
    "pier_frequency": "Pier frequency",
    "average_25ms": "25 ms average",
    "code_ratio": "25 ms average over 600 kip (AASHTO LRFD)",
    "largest_shear": "Shear",
    "largest_moment": "Moment",
    "utilisation": "Utilisation",
}


def summary_page(portfolio: Portfolio, system: str, sheets: Mapping[int, str]) -> bytes:
    """Return the page.

    Parameters
    ----------
    portfolio : Portfolio
        The results.
    system : {"SI", "US"}
        Units to print in.
    sheets : mapping of int to str
        Where the full sheets are, from the folder of the page, by place in the portfolio.
    """
    numbers, count = portfolio.numbers, len(portfolio.numbers["rank"])
    folder = shipped("templates") / "portfolio"
    style, script = (
        (folder / f"portfolio.{ending}").read_text(encoding="utf-8") for ending in ("css", "js")
    )
    columns = {column.name: column for column in RESULTS}
    shown = [columns[name] for name in SHOWN]
    policy = (
        f"default-src 'none'; style-src {_hash(style)}; script-src {_hash(script)}; "
        "img-src data:; base-uri 'none'; form-action 'none'"
    )
    environment = Environment(
        loader=FileSystemLoader(folder), autoescape=True, undefined=StrictUndefined
    )
    placed = np.isfinite(numbers["latitude"])
    # By utilisation where any pier has one; else by reaction.
    rated = bool(np.isfinite(numbers["utilisation"]).any())
    by, words = numbers["utilisation"], "Utilisation [-]"
    if not rated:
        by = numbers["design_reaction"] / unit_size("force", system)
        words = f"Design reaction [{unit_of('force', system)}]"
    distributions = map_of_them = ""
    if count:
        distributions = _picture(
            draw_distributions(
                numbers["design_reaction"],
                numbers["pier_frequency"],
                numbers["code_ratio"],
                numbers["utilisation"],
                system,
            )
        )
    if placed.any():
        latitude, longitude = (numbers[name][placed] for name in ("latitude", "longitude"))
        map_of_them = _picture(draw_map(latitude, longitude, by[placed], words))
    page = environment.get_template("portfolio.html.j2").render(
        distributions=distributions,
        map=map_of_them,
        policy=policy,
        version=pierimpact.__version__,
        name=portfolio.name,
        count=count,
        statement=_statement(portfolio),
        remarks=list(_remarks(portfolio)),
        shares=list(QUANTILES),
        quantiles=list(_quantiles(portfolio, shown, system)),
        map_words=words,
        placeless=int(np.count_nonzero(~placed)),
        columns=RESULTS,
        style=Markup(style),
        script=Markup(script),
        data=Markup(_data(portfolio, shown, system, sheets)),
    )
    return page.encode("utf-8", "replace")


def _hash(content: str) -> str:
    """Return the source expression by which a content security policy allows this content."""
    digest = hashlib.sha256(content.encode()).digest()
    return f"'sha256-{base64.b64encode(digest).decode()}'"


def _picture(svg: str) -> str:
    """Return a drawing as the address of an image."""
    return f"data:image/svg+xml;base64,{base64.b64encode(svg.encode()).decode()}"


def _statement(portfolio: Portfolio) -> str:
    utilisation = portfolio.numbers["utilisation"]
    if not len(utilisation):
        return f"No pier has results: all {portfolio.size:,} rows were rejected, by rejects.csv."
    rated = int(np.count_nonzero(np.isfinite(utilisation)))
    # Exactly: a utilisation above one is a resistance exceeded.
    exceeded = int(np.count_nonzero(utilisation > 1.0))
    if not rated:
        return f"{len(utilisation):,} piers; no row gives a resistance, so nothing is checked."
    return f"{exceeded:,} of {rated:,} piers with a resistance do not hold their truck."


def _remarks(portfolio: Portfolio) -> Iterator[str]:
    numbers, words = portfolio.numbers, portfolio.words
    count, utilisation = len(numbers["rank"]), numbers["utilisation"]
    # Exactly, as above.
    both = np.isfinite(numbers["utilisation_shear"]) & np.isfinite(numbers["utilisation_moment"])
    in_part = int(np.count_nonzero((utilisation <= 1.0) & ~both))
    if in_part:
        yield (
            f"{in_part:,} of the others {'gives' if in_part == 1 else 'give'} one resistance, to "
            "shear or to moment: that holds, and the other effect is not checked."
        )
    at_upper = int(np.count_nonzero((utilisation <= 1.0) & (numbers["utilisation_high"] > 1.0)))
    if at_upper:
        yield (
            f"{at_upper:,} of the others do not hold every truck of the spread: their utilisation "
            "exceeds 1 at the upper end of the band."
        )
    unrated = int(np.count_nonzero(np.isnan(utilisation)))
    if unrated and unrated < count:
        yield f"{unrated:,} rows give no resistance; they rank last, by reaction."
    unusual = int(np.count_nonzero(words["unusual"] != ""))
    if unusual:
        yield (
            f"{_rows(unusual)} {'has' if unusual == 1 else 'have'} unusual values, a slip of a "
            "unit most likely: the warnings name the columns."
        )
    beyond = int(np.count_nonzero(numbers["in_mass_range"] == 0.0))
    if beyond:
        yield (
            f"The truck of {_rows(beyond)} is heavier or lighter than the springs of its truck "
            "stand for."
        )
    for status in sorted(set(portfolio.statuses.values())):
        names = [name for name, own in portfolio.statuses.items() if own == status]
        of_rows = int(np.count_nonzero(np.isin(words["truck"], names)))
        if of_rows:
            yield (
                f"The trucks of {_rows(of_rows)} are {status}: {', '.join(sorted(names))}. Results "
                "are no better than their parameters."
            )
    beams = int(np.count_nonzero(np.isfinite(numbers["beam_shear"])))
    low = int(np.count_nonzero(words["static_forces"] != "hold"))
    if low:
        yield (
            f"Static member forces may be too low for {low:,} of the piers; {beams:,} in all are "
            f"calculated as a {BEAM}, and the others of these are checked under the largest "
            "contact force as a static force, unless their row asks for the static reaction."
        )
    if len(portfolio.rejects):
        yield f"{len(portfolio.rejects):,} of {portfolio.size:,} rows have no results: rejects.csv."
    if count > LISTED:
        yield f"The table below has the worst {LISTED:,} piers; results.csv has all."
    if np.isfinite(numbers["band_low"]).any():
        yield (
            f"Bands are of {SIZE} sampled trucks a pier, by the closed spectra where these hold. "
            "Those of a report have a thousand by the full model: of 634 random piers 9 of 10 ends "
            "were within 6 % of these, 98 of 100 within 10 %, and all within 21 %; the farthest "
            "were of slow trucks."
        )


def _rows(count: int) -> str:
    return f"{count:,} row{'s' * (count != 1)}"


def _quantiles(
    portfolio: Portfolio, shown: list[ResultColumn], system: str
) -> Iterator[tuple[str, list[str]]]:
    for column in shown:
        if column.name not in _OF_THE_TABLE:
            continue
        values = column.numbers(portfolio, system)
        values = values[np.isfinite(values)]
        if len(values):
            unit = unit_of(column.quantity, system)
            label = _OF_THE_TABLE[column.name] + (f" [{unit}]" if unit else "")
            found = np.quantile(values, list(QUANTILES.values()))
            yield label, [rounded(float(value), 3) for value in found]


def _data(
    portfolio: Portfolio, shown: list[ResultColumn], system: str, sheets: Mapping[int, str]
) -> str:
    """Return the rows as JSON that stands in a script element."""
    data: dict[str, Any] = {
        "headings": [column.heading(system) for column in shown],
        "words": [column.is_word for column in shown],
        "columns": [column.cells(portfolio, system)[:LISTED] for column in shown],
        "sheets": {place: address for place, address in sheets.items() if place < LISTED},
    }
    text = json.dumps(data, ensure_ascii=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")
