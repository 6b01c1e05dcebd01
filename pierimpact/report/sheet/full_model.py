"""The collision by the full model: what it solves, its history and peaks, and the check by it."""

from pierimpact.collision.history import Peak
from pierimpact.plots.history import draw_history
from pierimpact.report.document.blocks import Block
from pierimpact.report.document.markup import Inline, Tex, in_tex
from pierimpact.report.document.numbered import Equation, Figure, Steps, Table, columns, decimal
from pierimpact.report.sheet.section import Section
from pierimpact.symbols import SYMBOLS
from pierimpact.units import rounded


class FullModel(Section):
    """The collision by the full model."""

    def equations(self) -> Steps:
        """Return the equations of motion and the crush law that the full model solves."""
        on_pier = self.case.truck.friction_on == "pier"
        relative = r"\dot x_2 - \dot x_\mathrm{p}" if on_pier else r"\dot x_2"
        where = "while its spring touches the pier" if on_pier else "from the road"
        on_the_pier = r" + F_\mathrm{f}" if on_pier else ""
        ours, paper = "derived here", "Fig. 2 of the source paper"
        rows = (
            ("crush", "Crush of the springs of engine and body", r"\delta_i",
             r"x_i - x_\mathrm{p} \quad (i = 1, 2)", ""),
            ("envelope", "Envelope, up to the plateau’s end and beyond", r"E_i(\delta)",
             r"\min(k_{\mathrm{u}i} \, \delta, P_i) \ \text{ where } \delta \le d_i, "
             r"\quad P_i + k_i \, (\delta - d_i) \ \text{ beyond}", ours),
            ("force", "Force of a spring, with its largest crush so far", "F_i",
             r"\max(E_i(\delta_{i,\max}) - k_{\mathrm{u}i} \, (\delta_{i,\max} - \delta_i), 0)",
             ours),
            ("friction", f"Friction on the body, {where}", r"F_\mathrm{f}",
             rf"c_\mathrm{{s}} \operatorname{{sgn}}({relative}), "
             r"\quad \text{at rest, whatever holds the body, up to } c_\mathrm{s}", ours),
            ("engine", "Motion of the engine", r"m_1 \, \ddot x_1", "-F_1", paper),
            ("body", "Motion of body and cargo", r"m_2 \, \ddot x_2",
             r"-F_2 - F_\mathrm{f}", paper),
            ("pier", "Motion of the pier",
             r"m_\mathrm{p} \, \ddot x_\mathrm{p} + c_\mathrm{p} \, \dot x_\mathrm{p}"
             r" + k_\mathrm{p} \, x_\mathrm{p}", f"F_1 + F_2{on_the_pier}", paper),
        )  # fmt: skip
        return Steps(
            [
                Equation(label=f"eq-model-{label}", name=name, symbol=symbol, lines=[formula],
                         source=source)
                for label, name, symbol, formula, source in rows
            ]
        )  # fmt: skip

    def symbols(self) -> dict[str, str]:
        """Return the anchors of the symbols of the full model, by name."""
        return {
            "delta_i": "eq-model-crush",
            "E_i": "eq-model-envelope",
            "F_i": "eq-model-force",
            "F_f": "eq-model-friction",
            "x_i": "eq-model-crush",
            "x_p": "eq-model-pier",
            "R_t": "fig-history",
            "R": "eq-design-reaction",
            "R_D": "tab-check",
            "R_M": "tab-check",
        }

    def history(self) -> Block:
        """Return reaction and contact force against time."""
        history = self.calculation.history
        words = f"The engine peak is {self._peak_words(history.engine_peak)}"
        words += (
            "; there is no cargo peak"
            if history.cargo_peak is None
            else f", the cargo peak {self._peak_words(history.cargo_peak)}"
        )
        return Figure(
            label="fig-history",
            caption=(
                "Reaction ",
                Tex(r"R = k_\mathrm{p} x_\mathrm{p}"),
                " (thick) and contact force between truck and pier (thin) against time.",
            ),
            alt=f"Reaction against time. {words}.",
            svg=draw_history(history, self.system),
        )

    def _peak_words(self, peak: Peak) -> str:
        return f"{self.shown(peak.reaction, 'force')} after {self.shown(peak.time, 'time')}"

    def peaks(self) -> Block:
        """Return contact times and peaks of engine and cargo, and which governs."""
        history = self.calculation.history
        peaks = (
            ("Engine", history.engine_contact_time, history.engine_peak),
            ("Cargo", history.cargo_contact_time, history.cargo_peak),
        )
        rows: list[list[Inline]] = [
            [
                name,
                self.number(contact, "time"),
                self.number(peak.reaction if peak else None, "force"),
                self.number(peak.time, "time") if peak else "",
                "governs" if name.lower() == history.governs else "",
            ]
            for name, contact, peak in peaks
        ]
        time, force = self.unit("time"), self.unit("force")
        return Table(
            label="tab-peaks",
            caption="Contacts and peak reactions.",
            columns=columns(
                "",
                decimal(f"Contact after [{time}]"),
                decimal(f"Peak reaction [{force}]"),
                decimal(f"Peak after [{time}]"),
                "",
            ),
            rows=rows,
            strong=[["engine", "cargo"].index(history.governs)],
        )

    def averages(self) -> Block:
        """Return the largest contact force and its largest moving averages."""
        history = self.calculation.history
        largest = int(history.contact_force.argmax())
        force, time = float(history.contact_force[largest]), float(history.time[largest])
        rows = [["At one instant", self.number(force, "force"), self.number(time, "time")]]
        for window, average in self.calculation.average_forces.items():
            name = f"Over {self.shown(window, 'time', given=True)}"
            if average is None:  # the collision is over sooner
                rows.append([name, "none", ""])
            else:
                start = self.number(average.start, "time")
                rows.append([name, self.number(average.force, "force"), start])
        return Table(
            label="tab-averages",
            caption="Largest contact force between truck and pier by the full model, and its "
            "largest moving averages. The value of AASHTO LRFD was taken from the 25 ms average of "
            "a test.",
            columns=columns(
                "Average",
                decimal(f"Contact force [{self.unit('force')}]"),
                decimal(f"From [{self.unit('time')}]"),
            ),
            rows=rows,
        )

    def check(self) -> Block:
        """Return the design procedure beside the full model, with the ratio."""
        history = self.calculation.history
        long, short = self.calculation.design, self.calculation.short
        cargo = history.cargo_peak
        reactions = {
            "Engine": (history.engine_peak.reaction, long.engine, short.engine),
            "Cargo": (cargo.reaction if cargo else None, long.cargo, short.cargo),
            "Governing": (history.governing_peak.reaction, long.reaction, short.reaction),
        }
        rows: list[list[Inline]] = []
        for name, (exact, *closed) in reactions.items():
            rows.append([name, self.number(exact, "force")])
            for value in closed:
                ratio = "" if value is None or exact is None else rounded(value / exact, 3)
                rows[-1] += [self.number(value, "force"), ratio]
        force = self.unit("force")
        return Table(
            label="tab-check",
            caption="Reactions by the full model and by the two levels of the design procedure, "
            "each with its ratio to the full model.",
            columns=columns(
                "Reaction",
                decimal(f"Full model [{force}]"),
                decimal(f"Design procedure [{force}]"),
                decimal("Ratio"),
                decimal(f"Short level [{force}]"),
                decimal("Ratio"),
            ),
            rows=rows,
            strong=[2],
        )

    def design_reaction(self) -> Steps:
        """Return the design reaction: the larger of procedure and full model."""
        result = self.calculation
        procedure, model, larger = (
            in_tex(self.shown(force, "dynamic force"))
            for force in (
                result.design.reaction,
                result.governing_peak.reaction,
                result.design_force,
            )
        )
        names = ", ".join(SYMBOLS[name].latex for name in ("R_D", "R_M"))
        return Steps(
            [
                Equation(
                    label="eq-design-reaction",
                    name="Design reaction: procedure or full model",
                    symbol=SYMBOLS["R"].latex,
                    lines=[rf"\max({names})", rf"\max({procedure}, {model}) = {larger}"],
                )
            ]
        )
