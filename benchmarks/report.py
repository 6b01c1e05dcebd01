"""Time of a report beyond the kernel's own start: python benchmarks/report.py.

Runs `pierimpact report` on the example, in turn with the start of a kernel that executes nothing,
alone and by way of papermill, and on ten cases. Prints medians, least and most of each, of the
differences and of the report's parts.
"""

import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import nbformat
from nbformat import v4

ROUNDS, CASES = 5, 10
EXAMPLE = Path(__file__).parent.parent / "notebooks" / "tti-column.yaml"
EMPTY = """
import papermill
papermill.execute_notebook("empty.ipynb", "o.ipynb", kernel_name="python3", progress_bar=False)
"""
# The time of a kernel alone, without what is imported to start it.
KERNEL = """
import time
from jupyter_client.manager import start_new_kernel
start = time.perf_counter()
manager, client = start_new_kernel(kernel_name="python3")
client.execute_interactive("")
manager.shutdown_kernel(now=True)
print(time.perf_counter() - start)
"""
# In one process and one after the other; in a report some of them overlap.
PARTS = """
import sys, time
from pathlib import Path
times = [time.perf_counter()]
def lap():
    times.append(time.perf_counter())
from pierimpact.files.case import read_case_file
from pierimpact.report import exporters, write
from pierimpact.report.calculation import calculate
lap()
path = Path(sys.argv[1])
case_file = read_case_file(path); calculate(case_file.case); lap()
write.import_libraries(); lap()
with write.start_kernels([path]) as kernels:
    notebook = write._execute(case_file, path.parent, Path("x.ipynb"), kernels, lambda: None)
lap()
exporters.SheetHTMLExporter().from_notebook_node(notebook); lap()
exporters.SheetPDFExporter().from_notebook_node(notebook); lap()
print(*(after - before for before, after in zip(times, times[1:])))
"""
NAMES = ("imports", "calculation", "papermill's import", "kernel and cells", "HTML", "PDF")


def seconds(folder, *command):
    """Return the wall time of a command, and what it printed."""
    start = time.perf_counter()
    done = subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True)
    return time.perf_counter() - start, done.stdout


with tempfile.TemporaryDirectory() as folder:
    nbformat.write(v4.new_notebook(cells=[v4.new_code_cell("")]), Path(folder) / "empty.ipynb")
    cases = Path(folder) / "cases"
    cases.mkdir()
    for number in range(CASES):
        shutil.copy(EXAMPLE, cases / f"pier-{number}.yaml")
    whole, kernel, route, parts, many = [], [], [], [], []
    for _ in range(ROUNDS + 1):  # the first is not counted
        report = seconds(folder, sys.executable, "-m", "pierimpact", "report", EXAMPLE)[0]
        empty = seconds(folder, sys.executable, "-c", EMPTY)[0]
        shares = seconds(folder, sys.executable, "-c", PARTS, EXAMPLE)[1]
        whole.append(report)
        route.append(empty)
        kernel.append(float(seconds(folder, sys.executable, "-c", KERNEL)[1]))
        parts.append([float(share) for share in shares.split()])
        many.append(seconds(folder, sys.executable, "-m", "pierimpact", "report", cases)[0])
whole, kernel, route, parts, many = (values[1:] for values in (whole, kernel, route, parts, many))
beyond_kernel, beyond_route = (
    [report - empty for report, empty in zip(whole, times, strict=True)]
    for times in (kernel, route)
)
for name, values in (
    ("report", whole),
    ("kernel alone", kernel),
    ("report beyond it", beyond_kernel),
    ("empty notebook by papermill", route),
    ("report beyond it", beyond_route),
    (f"{CASES} cases", many),
    *zip((f"  {name}" for name in NAMES), zip(*parts, strict=True), strict=True),
):
    print(f"{name:28} {statistics.median(values):5.2f} s ({min(values):.2f} to {max(values):.2f})")
ratio = statistics.median(ten / one for ten, one in zip(many, whole, strict=True))
print(f"{CASES} cases take {ratio:.1f} times as long as one")
