"""Predict, then see: a choice that locks before an explorer shows the answer."""

import html

import ipywidgets as ipw

from pierimpact.plots.style import GREEN, VERMILION
from pierimpact.teaching.explorer import Explorer
from pierimpact.teaching.markup import FRAME, Shown, choice_list, indexed, muted, paragraph, still
from pierimpact.teaching.questions import lesson as lesson_of
from pierimpact.teaching.work import work_on


class PredictionBox:
    """The prediction of a lesson, to be made before its explorer shows.

    Parameters
    ----------
    lesson : str
        Name of the lesson.
    """

    def __init__(self, lesson: str) -> None:
        self.prediction, self.kept = lesson_of(lesson).prediction, work_on(lesson)
        self.choice = ipw.RadioButtons(
            options=tuple(self.prediction.choices),
            value=self.kept.work.prediction or None,
            description="Your prediction",
            layout=ipw.Layout(width="auto"),
            style={"description_width": "initial"},
        )
        self.button = ipw.Button(description="Lock my prediction", layout=ipw.Layout(width="170px"))
        self.button.on_click(self.lock)
        self.message = ipw.HTML()
        self.widget = ipw.VBox(
            [ipw.HTML(self._asked()), self.choice, self.button, self.message],
            layout=ipw.Layout(border_left=FRAME, padding="2px 0 4px 12px"),
        )
        self._shown = Shown(self.widget)
        self._follow()
        self.kept.watchers.append(self._follow)

    def lock(self, *_: object) -> None:
        """Lock the choice; from then on the explorer shows."""
        if self.choice.value is None:
            self.message.value = paragraph(
                "Choose first. A wrong guess costs nothing.", role="status"
            )
            return
        self.kept.predict(self.choice.value)

    def _follow(self) -> None:
        made = self.kept.work.prediction
        self.choice.disabled = self.button.disabled = bool(made)
        if made:
            words = "Locked. Now see what happens, below."
            self.message.value = paragraph(words, role="status")
        note = paragraph(f"<b>Predicted:</b> {html.escape(made)}") if made else ""
        self._shown.instead(still(f"{self._asked()}{choice_list(self.prediction.choices)}{note}"))

    def _asked(self) -> str:
        return paragraph(f"<b>Predict.</b> {indexed(self.prediction.words)}", "max-width:780px")

    def _ipython_display_(self) -> None:
        self._shown.display()


class Revealed:
    """An explorer that shows once the prediction is locked, with what came of it above.

    Parameters
    ----------
    lesson : str
        Name of the lesson.
    explorer : Explorer
        Its explorer.
    """

    def __init__(self, lesson: str, explorer: Explorer) -> None:
        self.prediction, self.kept = lesson_of(lesson).prediction, work_on(lesson)
        self.explorer, self.words = explorer, ipw.HTML()
        self.widget = ipw.VBox([self.words, explorer.widget])
        self._shown = Shown(self.widget, explorer.title)
        self._shown.instead(explorer.still)
        self._follow()
        self.kept.watchers.append(self._follow)

    def _follow(self) -> None:
        made = self.kept.work.prediction
        self.explorer.widget.layout.display = "flex" if made else "none"
        if not made:
            self.words.value = paragraph("The explorer shows here once your prediction is locked.")
            return
        answer = self.prediction.answer()
        colour, sign = (GREEN, "✓") if made == answer else (VERMILION, "✗")
        came = "" if made == answer else f" It is: <b>{html.escape(answer)}</b>."
        self.words.value = paragraph(
            f'<b style="color:{colour}">{sign}</b> You predicted: {html.escape(made)}.{came}<br>'
            f"{indexed(self.prediction.choices[made])}{muted(indexed(self.prediction.look))}",
            "max-width:780px;padding-bottom:8px",
            role="status",
        )

    def _ipython_display_(self) -> None:
        self._shown.display()


def ask(lesson: str) -> PredictionBox:
    """Return the prediction of a lesson, to be made before its explorer shows.

    Once it is locked it is kept in the file of the lesson, in the folder of the notebook.

    Parameters
    ----------
    lesson : str
        Name of the notebook's subject, such as "collision".

    Returns
    -------
    PredictionBox
        The choices and a button, as a notebook shows them.

    Raises
    ------
    InputError
        When there is no such lesson.

    Examples
    --------
    >>> from pierimpact import predictions
    >>> prediction = predictions.ask("collision")
    >>> prediction.choice.options[1]
    'two spikes: first the engine’s, later the cargo’s'
    """
    return PredictionBox(lesson)


def reveal(lesson: str, explorer: Explorer) -> Revealed:
    """Return an explorer that shows once the prediction of the lesson is locked.

    Parameters
    ----------
    lesson : str
        Name of the lesson.
    explorer : Explorer
        Its explorer, such as `widgets.collision()`.

    Returns
    -------
    Revealed
        The explorer with what came of the prediction, as a notebook shows them.

    Raises
    ------
    InputError
        When there is no such lesson.

    Examples
    --------
    >>> from pierimpact import predictions, widgets
    >>> explorer = widgets.collision()
    >>> revealed = predictions.reveal("collision", explorer)
    >>> explorer.widget.layout.display  # until the prediction is locked
    'none'
    """
    return Revealed(lesson, explorer)
