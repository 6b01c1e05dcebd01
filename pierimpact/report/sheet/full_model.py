"""The collision by the full model: what it solves, its history and peaks, and what balances."""

import numpy as np

from pierimpact.collision.history import Peak
from pierimpact.plots.history import draw_history
from pierimpact.report.document.blocks import Beside, Block
from pierimpact.report.document.markup import Inline, Tex, in_tex
from pierimpact.report.document.numbered import Figure, Table, columns, decimal, wide
from pierimpact.report.sheet.section import Section
from pierimpact.symbols import SYMBOLS
from pierimpact.units import rounded


class FullModel(Section):
    """The collision by the full model.

    Examples
    --------
    >>> from pierimpact.files.case import read_case_file
    >>> from pierimpact.report.sheet import Sheet
    >>> from pierimpact.resources import shipped
    >>> file = read_case_file(shipped("notebooks") / "tti-column.yaml")
    >>> sheet = Sheet(file.case)
    >>> sheet.model.averages().rows[2]  # of the contact force [kN], and from when on [ms]
    ['Over 25 ms', '3749', '123.6']
    """

    def equations(self) -> Block:
        """Return the equations of motion and the crush law that the full model solves."""
        on_pier = self.case.truck.friction_on == "pier"
        relative = r"\dot x_2 - \dot x_\mathrm{p}" if on_pier else r"\dot x_2"
        where = "while it touches the pier" if on_pier else "from the road"
        on_the_pier = r" + F_\mathrm{f}" if on_pier else ""
        ours, paper = "derived here", "source paper, Fig. 2"
        rows = (
            ("Crush of either spring", r"\delta_i",
             r"x_i - x_\mathrm{p} \quad (i = 1, 2)", ""),
            ("Envelope: plateau, then rise", r"E_i(\delta)",
             r"\min(k_{\mathrm{u}i} \, \delta, P_i) \ \text{ where } \delta \le d_i, "
             r"\quad P_i + k_i \, (\delta - d_i) \ \text{ beyond}", ours),
            ("Force, from its largest crush", "F_i",
             r"\max(E_i(\delta_{i,\max}) - k_{\mathrm{u}i} \, (\delta_{i,\max} - \delta_i), 0)",
             ours),
            (f"Friction on the body, {where}", r"F_\mathrm{f}",
             rf"c_\mathrm{{s}} \operatorname{{sgn}}({relative}), "
             r"\quad \text{at rest, whatever holds the body, up to } c_\mathrm{s}", ours),
            ("Motion of the engine", r"m_1 \, \ddot x_1", "-F_1", paper),
            ("Motion of body and cargo", r"m_2 \, \ddot x_2",
             r"-F_2 - F_\mathrm{f}", paper),
            ("Motion of the pier",
             r"m_\mathrm{p} \, \ddot x_\mathrm{p} + c_\mathrm{p} \, \dot x_\mathrm{p}"
             r" + k_\mathrm{p} \, x_\mathrm{p}", f"F_1 + F_2{on_the_pier}", paper),
        )  # fmt: skip
        return Table(
            label="tab-model",
            caption="The full model: crush law and equations of motion.",
            columns=columns(wide("Quantity"), "Equation", "From"),
            rows=[
                [name, Tex(f"{symbol} = {formula}"), source]
                for name, symbol, formula, source in rows
            ],
            centred=True,
        )

    def symbols(self) -> dict[str, str]:
        """Return the anchors of the symbols of the full model, by name."""
        return {
            **dict.fromkeys(("delta_i", "E_i", "F_i", "F_f", "x_i", "x_p"), "tab-model"),
            "R_t": "fig-history",
            "R": "tab-peaks",
        }

    def history(self) -> Block:
        """Return reaction and contact force against time."""
        history = self.calculation.history
        words = f"The {history.before_cargo} peak is {self._peak_words(history.engine_peak)}"
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
            alt=f"Reaction against time. {words}. The lowest is "
            f"{self._peak_words(history.lowest)}.",
            svg=draw_history(history, self.system),
        )

    def _peak_words(self, peak: Peak) -> str:
        return f"{self.shown(peak.reaction, 'force')} after {self.shown(peak.time, 'time')}"

    def peaks(self) -> Block:
        """Return contact times, peaks and lowest point of the reaction, and which governs."""
        history = self.calculation.history
        peaks = (
            (
                history.before_cargo.capitalize(),
                history.engine_contact_time,
                history.engine_peak,
            ),
            ("Cargo", history.cargo_contact_time, history.cargo_peak),
        )
        rows: list[list[Inline]] = [
            [
                name,
                self.number(contact, "time"),
                self.number(peak.reaction if peak else None, "force"),
                self.number(peak.time, "time") if peak else "",
                "governs" if name.lower() == self.calculation.governs else "",
            ]
            for name, contact, peak in peaks
        ]
        lowest = history.lowest
        lowest_values = self.number(lowest.reaction, "force"), self.number(lowest.time, "time")
        share = rounded(100.0 * lowest.reaction / self.calculation.design_force, 2)
        words = f"reversal, {share} %" if lowest.reaction < 0.0 else "no reversal"
        rows.append(["Lowest", "", *lowest_values, words])
        time, force = self.unit("time"), self.unit("force")
        return Table(
            label="tab-peaks",
            caption=(
                "Contacts, peaks and lowest point of the reaction. The governing peak is the "
                "design reaction ",
                Tex(SYMBOLS["R"].latex),
                ".",
            ),
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

    def _end(self) -> str:
        return f"after {self.shown(float(self.calculation.history.time[-1]), 'time')}"

    def energy(self) -> Block:
        """Return where the truck's energy is at the governing peak and at the end."""
        result, history = self.calculation, self.calculation.history
        peak, energy = history.governing_peak, history.energy
        shares: list[tuple[str, float, float]] = [
            (name, float(np.interp(peak.time, history.time, values)), float(values[-1]))
            for name, values in (
                ("Motion of engine, body and pier", energy.kinetic),
                ("Crushing of engine and body", energy.crush + energy.truck_elastic),
                ("Friction", energy.friction),
                ("Damping of the pier", energy.damping),
            )
        ]
        strain = 0.5 * peak.reaction**2 / result.pier.stiffness
        shares.insert(1, ("Deflection of the pier", strain, float(energy.pier_elastic[-1])))
        shares.append(("Sum", sum(share[1] for share in shares), sum(share[2] for share in shares)))
        brought = history.collision.energy
        whole = self.shown(brought, "energy")
        return Table(
            label="tab-energy",
            caption=(
                f"Energy at the governing peak and at the end, {self._end()}. The sums are the "
                "truck’s at first touch, ",
                Tex(r"(m_1 + m_2) \, V^2 / 2 = " + in_tex(whole)),
                "; the deflection at the peak is ",
                Tex(r"R_\mathrm{d}^2 / 2 k_\mathrm{p}"),
                ".",
            ),
            columns=columns(
                "Energy in",
                decimal(f"Peak [{whole.unit}]"),
                decimal(f"End [{whole.unit}]"),
            ),
            rows=[
                [
                    name,
                    *(self.number(_above_round_off(value, brought), "energy") for value in values),
                ]
                for name, *values in shares
            ],
            strong=[len(shares) - 1],
        )

    def momentum(self) -> Block:
        """Return where the truck's momentum has gone by the end."""
        truck, history = self.case.truck, self.calculation.history
        rows = [
            ("Engine", truck.engine_mass * float(history.engine_velocity[-1])),
            ("Body and cargo", truck.body_mass * float(history.body_velocity[-1])),
            ("Impulse on the pier", float(history.impulse[-1])),
            ("Impulse of the road’s friction", float(history.road_impulse[-1])),
        ]
        rows.append(("Sum", sum(value for _, value in rows)))
        brought = truck.mass * self.case.inputs.speed
        whole = self.shown(brought, "impulse")
        return Table(
            label="tab-momentum",
            caption=(
                f"Momentum at the end, {self._end()}, and impulses up to then. The sum is the "
                "truck’s at first touch, ",
                Tex(r"(m_1 + m_2) \, V = " + in_tex(whole)),
                ".",
            ),
            columns=columns("Of", decimal(f"Value [{whole.unit}]")),
            rows=[
                [name, self.number(_above_round_off(value, brought), "impulse")]
                for name, value in rows
            ],
            strong=[len(rows) - 1],
        )

    def balances(self) -> Block:
        """Return energy and momentum, the check by hand of the full model."""
        # The share is a width by eye, this project's choice.
        return Beside(left=[self.energy()], right=[self.momentum()], share=0.56)

    def averages(self) -> Block:
        """Return the largest contact force and its largest moving averages."""
        history = self.calculation.history
        largest = int(history.contact_force.argmax())
        force, time = float(history.contact_force[largest]), float(history.time[largest])
        rows = [["At one instant", self.number(force, "force"), self.number(time, "time")]]
        for window, average in self.calculation.average_forces.items():
            name = f"Over {self.shown(window, 'time', given=True)}"
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


def _above_round_off(value: float, brought: float) -> float:
    """Return a value, or zero where nothing but round-off is left of what the truck brings."""
    return value if abs(value) > 1e-9 * brought else 0.0  # numerical
