"""The form as a widget: what the browser asks, and what it is answered."""

import atexit
from concurrent.futures import ThreadPoolExecutor
from functools import cached_property
from pathlib import Path
from typing import Any

import anywidget
import traitlets

from pierimpact.app.form import fields
from pierimpact.app.session import Session
from pierimpact.checks import InputError, shortened
from pierimpact.report.kernel import Kernels
from pierimpact.report.write import ReportError, import_libraries, stages, start_kernels
from pierimpact.teaching import browser


class Form(anywidget.AnyWidget):
    """The form, on a page of its own.

    Parameters
    ----------
    case : str, optional
        Case file to begin with; an example where there is none.

    Raises
    ------
    InputError
        When the case file cannot be read.
    """

    _esm = traitlets.Unicode().tag(sync=True)
    _css = traitlets.Unicode().tag(sync=True)
    setup = traitlets.Dict().tag(sync=True)  #: the fields, as `form.fields` gives them

    @traitlets.default("_esm")
    def _default_esm(self) -> str:
        return f"{browser.script('app')}export default {{ render: appModule.render }};\n"

    @traitlets.default("_css")
    def _default_css(self) -> str:
        return browser.stylesheet("app")

    def __init__(self, case: str | None = None) -> None:
        self.session = Session(None if case is None else Path(case))
        atexit.register(self.session.close)
        self._reports = ThreadPoolExecutor(1)  # one after the other, while the form goes on
        self._written: tuple[tuple[str, str], dict[str, bytes]] | None = None
        super().__init__(setup=fields())
        self.on_msg(self._hear)

    def _hear(self, _: object, asked: dict[str, Any], buffers: list[Any]) -> None:
        """Do what the browser asks and answer it; what cannot be done is a line of text."""
        content = bytes(buffers[0]) if buffers else b""
        name, refused = str(asked.get("name", "")), {}
        try:
            match asked["do"]:
                case "new":
                    self.session.new(asked["units"])
                case "open":
                    self.session.open(name, content)
                case "add":
                    self.session.add(name, content)
                case "change":
                    self.session.change(name, asked["typed"])
                case "report":
                    self._reports.submit(self._report, asked["ending"])
                    return
        except InputError as error:
            refused = {"refused": str(error)}
        answer = self.session.answer() | refused
        self.send({"kind": "answer", "to": asked["do"], **answer})
        self._reports.submit(self._warm_up)  # once there is something to look at

    @cached_property
    def _kernels(self) -> Kernels:
        kernels = start_kernels([self.session.folder / "case.yaml"])
        atexit.register(kernels.__exit__)
        return kernels

    def _warm_up(self) -> None:
        if "_kernels" not in vars(self):
            assert self._kernels
            import_libraries()

    def _report(self, ending: str) -> None:
        """Write the report, unless that of this very case is there, and send one of its files."""
        case, done = (self.session.name, self.session.text), 0

        def on_stage() -> None:
            nonlocal done
            done += 1
            self.send({"kind": "progress", "share": done / stages(docx=True)})

        try:
            if self._written is None or self._written[0] != case:
                self._written = case, self.session.report(self._kernels, on_stage)
        except (InputError, ReportError) as error:
            self.send({"kind": "failed", "words": str(error)})
        except Exception as error:  # the form goes on, whatever it is
            words = f"{type(error).__name__}: {shortened(str(error), 300)}"
            self.send({"kind": "failed", "words": f"{words}; this is a defect of the program"})
        else:
            name = Path(case[0]).stem + ending
            self.send({"kind": "file", "name": name}, buffers=[self._written[1][ending]])
