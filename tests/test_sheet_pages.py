"""The pages of a sheet: as many as a checker likes to sign, and none that is nearly empty."""

from pathlib import Path

import pypdf
import pytest
import yaml
from sheet_page import US_CASE

from pierimpact.report.write import write_report

EXAMPLE = Path(__file__).parent.parent / "notebooks" / "tti-column.yaml"
LOGO = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="60" height="11"><path d="M0 0h60v11z"/></svg>'
)
HEAVY = {
    "project": "Overpass at the end of a road with quite a long name",
    "job_number": "2026-117",
    "element": "Pier 3, hammerhead, northbound",
    "revision": "B",
    "revisions": [
        {"revision": revision, "date": "2026-03-02", "description": words, "by": "—"}
        for revision, words in (("A", "First issue"), ("B", "Column stepped at 12 ft"))
    ],
    "office": "The office",
    "logo": "logo.svg",
    "column_shape": "rectangular",
    "column_width": "8 ft",
    "column_depth": "4 ft",
    "column_height": "24 ft 6 in",
    "steps": [
        {
            "height": "12 ft",
            "column_shape": "rectangular",
            "column_width": "6 ft",
            "column_depth": "3 ft 6 in",
        }
    ],
    "concrete_strength": "4 ksi",
    "density": "150 lb/ft^3",
    "stiffness_factor": 0.5,
    "base": "fixed",
    "top": "free",
    "top_mass": "420000 lb",
    "truck": "single-unit-8t",
    "truck_mass": "24000 lb",
    "speed": "60 mph",
    "impact_height": "auto",
    "shear_resistance": "1900 kip",
    "moment_resistance": "9000 kip*ft",
    "notes": ["The mass of the cap has half of the span's dead load in it."],
}
SPRINGS = {
    "element": "Column on springs",
    "column_shape": "rectangular",
    "column_width": "1.5 m",
    "column_depth": "1.2 m",
    "column_height": "7.5 m",
    "concrete_strength": "30 MPa",
    "density": "2400 kg/m^3",
    "stiffness_factor": 0.5,
    "base": "fixed",
    "base_rotation_stiffness": "2500 MN*m/rad",
    "top": "pinned",
    "truck": "single-unit-8t",
    "speed": "90 km/h",
    "impact_height": "auto",
    "shear_resistance": "3.4 MN",
}
CASES = {
    "example": yaml.safe_load(EXAMPLE.read_text(encoding="utf-8")),
    "short": US_CASE,
    "hammerhead": HEAVY | {"units": "US"},
    "hammerhead in metres": HEAVY,
    "springs": SPRINGS | {"office": "The office", "logo": "logo.svg"},
    "springs in feet": SPRINGS | {"units": "US"},
    "crawling": SPRINGS | {"impact_height": "1.2 m", "speed": "3 km/h"},
}


@pytest.fixture(scope="module", params=CASES)
def pages(request, tmp_path_factory):
    """Return where text stands on each page, from its top as shares of its height."""
    folder = tmp_path_factory.mktemp("pages")
    (folder / "logo.svg").write_text(LOGO)
    case = folder / "case.yaml"
    case.write_text(yaml.safe_dump(CASES[request.param]), encoding="utf-8")
    made = []
    for page in pypdf.PdfReader(write_report(case, folder).pdf).pages:
        places = []

        def place(words, outer, inner, *_, places=places, top=float(page.mediabox.top)):
            if words.strip():
                y = outer[1] * inner[4] + outer[3] * inner[5] + outer[5]
                places.append((1.0 - y / top, words))

        page.extract_text(visitor_text=place)
        made.append(places)
    return made


def test_a_checker_signs_on_page_one_of_seven_at_most(pages):
    signed = [
        number
        for number, page in enumerate(pages)
        if any("Signature" in words for _, words in page)
    ]
    assert signed == [0]
    assert len(pages) <= 7


def test_no_page_is_nearly_empty(pages):
    for page in pages:
        body = [place for place, _ in page if 0.08 < place < 0.92]
        assert max(body) > 0.35
