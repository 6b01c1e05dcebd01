"""The page of a case's report without a kernel: the report's notebook, run cell by cell here."""

import ast
import json

from nbformat import v4

from pierimpact.report.exporters import SheetHTMLExporter
from pierimpact.report.write import report_notebook

US_CASE = {
    "column_shape": "rectangular",
    "column_width": "4 ft",
    "column_depth": "36 in",
    "column_height": "16.5 ft",
    "concrete_strength": "4 ksi",
    "density": "150 lb/ft^3",
    "base": "fixed",
    "top": "fixed",
    "truck": "single-unit-8t",
    "truck_mass": "36000 lb",
    "speed": "55 mph",
    "impact_height": "auto",
    "damping_ratio": 0.03,
    "units": "US",
    "shear_resistance": "3000 kip",
    "moment_resistance": "2500 kip*ft",
}


def executed(values):
    """Return the report's notebook of a case's keys and values, with its outputs."""
    namespace, cells = {}, []
    for index, cell in enumerate(json.loads(report_notebook().read_text("utf-8"))["cells"]):
        source = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            cells.append(v4.new_markdown_cell(source))
            continue
        *statements, last = ast.parse(source).body
        if index == 0:  # the parameters, which the case's own follow
            exec(source, namespace)
            namespace |= values
            continue
        exec(compile(ast.Module(statements, []), "cell", "exec"), namespace)
        block = eval(compile(ast.Expression(last.value), "cell", "eval"), namespace)
        if block is None:  # as a notebook shows nothing of it
            continue
        output = v4.new_output("display_data", block._repr_mimebundle_())
        cells.append(v4.new_code_cell(outputs=[output]))
    return v4.new_notebook(cells=cells)


def page_of(values):
    """Return the HTML page of the report of a case's keys and values."""
    page, _ = SheetHTMLExporter().from_notebook_node(executed(values))
    return page
