"""Every quantity once: what it means, its symbol, and what kind of quantity it is.

Case files, truck files, the sheet with its nomenclature, the domain of the study and the
explorers read from here. The names are those of the calculations in `pier` and `design`.
"""

from typing import NamedTuple


class Symbol(NamedTuple):
    """A quantity as it is spoken of and printed."""

    meaning: str  #: as within a sentence; mathematics between dollar signs
    latex: str = ""  #: symbol; empty where it is only spoken of
    quantity: str = ""  #: kind, of `units.QUANTITIES`; empty for a word
    key: str = ""  #: name in a case file or a truck file, where it has one

    @property
    def heading(self) -> str:
        """The meaning as it begins a line."""
        return self.meaning[:1].upper() + self.meaning[1:]


def _spring(body: str, i: int) -> dict[str, Symbol]:
    """Return the parameters of the crush law of a body's spring."""
    spring, key = f"of the {body} spring", f"{body}_spring"
    return {
        f"P{i}": Symbol(f"plateau force {spring}", f"P_{i}", "force", f"{key}.plateau_force"),
        f"d{i}": Symbol(f"plateau length {spring}", f"d_{i}", "length", f"{key}.plateau_length"),
        f"k{i}": Symbol(f"steep stiffness {spring}", f"k_{i}", "stiffness", f"{key}.stiffness"),
        f"ku{i}": Symbol(
            f"unloading stiffness {spring}",
            rf"k_{{\mathrm{{u}}{i}}}",
            "stiffness",
            f"{key}.unloading_stiffness",
        ),
    }


def _spectrum(body: str, i: int) -> dict[str, Symbol]:
    """Return what the unified spectrum is of, for engine or cargo."""
    return {
        f"beta{i}": Symbol(f"frequency ratio, {body}", rf"\beta_{i}", "share"),
        f"mu{i}": Symbol(f"mass ratio, {body}", rf"\mu_{i}", "share"),
        f"e{i}": Symbol(f"restitution, {body}", f"e_{i}", "share"),
        f"h{i}": Symbol(f"resonance term of the spectrum, {body}", f"h_{i}", "share"),
        f"S{i}": Symbol(f"amplification, {body}", f"S_{i}", "share"),
    }


def _mode(mode: str) -> dict[str, Symbol]:
    """Return what describes the slow or the fast mode of pier and cargo."""
    s = mode[0]
    index = rf"\mathrm{{{s}}}"
    return {
        f"omega_{s}": Symbol(
            f"{mode} mode: circular frequency", rf"\omega_{index}", "circular frequency"
        ),
        f"psi_{s}": Symbol(
            f"{mode} mode: displacement of the body over the pier’s", rf"\psi_{index}", "share"
        ),
        f"sigma_{s}": Symbol(f"{mode} mode: decay rate", rf"\sigma_{index}", "decay rate"),
        f"a_{s}": Symbol(f"{mode} mode: cosine part", f"a_{index}", "length"),
        f"b_{s}": Symbol(f"{mode} mode: sine part", f"b_{index}", "length"),
        f"X_{s}": Symbol(f"{mode} mode: amplitude", f"X_{index}", "length"),
        f"phi_{s}": Symbol(f"{mode} mode: phase", rf"\varphi_{index}", "angle"),
        f"theta_{s}": Symbol(
            f"{mode} mode: angle of the first maximum, from 0 to 2π", rf"\theta_{index}", "angle"
        ),
    }


def _shape(part: str, end: str) -> dict[str, Symbol]:
    """Return what the shape function below or above the impact is made of."""
    where, other = f"shape {part} the impact", {"b": "base", "t": "top"}[end]
    terms = ("constant", "coefficient of $s$", "coefficient of $s^2$", "coefficient of $s^3$")
    limits = {"b": r"_0^{z_\mathrm{n}}", "t": r"_{z_\mathrm{n}}^H"}[end]
    return {
        f"s{end}": Symbol(
            f"relative distance of the impact from the {other}", rf"s_\mathrm{{{end}}}", "share"
        ),
        **{
            f"c{end}{power}": Symbol(
                f"{where}, {term}", rf"c_\mathrm{{{end}{power}}}", "share"
            )
            for power, term in enumerate(terms)
        },
        f"phi2{end}": Symbol(
            f"integral {part} the impact",
            rf"\int{limits} \varphi^2 \, \mathrm{{d}}z",
            "length",
        ),
    }  # fmt: skip


SYMBOLS = {
    # The column
    "column_shape": Symbol("shape of the section", key="column_shape"),
    "base": Symbol("base of the column", key="base"),
    "top": Symbol("top of the column", key="top"),
    "D": Symbol("column diameter", "D", "section length", "column_diameter"),
    "b": Symbol("column width, across the travel", "b", "section length", "column_width"),
    "h": Symbol("column depth, along the travel", "h", "section length", "column_depth"),
    "H": Symbol("column height", "H", "length", "column_height"),
    "E": Symbol("elastic modulus", "E", "modulus", "elastic_modulus"),
    "fc": Symbol("concrete strength", r"f_\mathrm{c}'", "strength", "concrete_strength"),
    "nu": Symbol("Poisson’s ratio", r"\nu", "ratio", "poisson_ratio"),
    "rho": Symbol("density", r"\rho", "density", "density"),
    # The collision
    "m": Symbol("total mass of the truck", "m_1 + m_2", "mass", "truck_mass"),
    "V": Symbol("speed at first touch", "V", "speed", "speed"),
    "z": Symbol("nominal impact height", r"z_\mathrm{n}", "length", "impact_height"),
    "zeta": Symbol("damping ratio of the pier", r"\zeta", "ratio", "damping_ratio"),
    "V_R": Symbol("shear resistance", r"V_\mathrm{R}", "force", "shear_resistance"),
    "M_R": Symbol("moment resistance", r"M_\mathrm{R}", "moment", "moment_resistance"),
    # The truck
    "m1": Symbol("engine mass", "m_1", "mass", "engine_mass"),
    "m2": Symbol("mass of body and cargo", "m_2", "mass", "body_mass"),
    "cs": Symbol("friction force on the body", r"c_\mathrm{s}", "force", "friction_force"),
    "friction_on": Symbol("friction acts against the", key="friction_on"),
    **_spring("engine", 1),
    **_spring("body", 2),
    # Section and equivalent pier
    "kappa": Symbol("shear coefficient", r"\kappa", "share"),
    "A": Symbol("area", "A", "area"),
    "I": Symbol("second moment of area", "I", "second moment"),
    "EI": Symbol("flexural rigidity", "EI", "flexural rigidity"),
    "G": Symbol("shear modulus", "G", "modulus"),
    "GA": Symbol("shear rigidity", r"\kappa GA", "shear rigidity"),
    "mbar": Symbol("mass per length", r"\bar m", "mass per length"),
    "y": Symbol("height of the top above the impact", r"(H - z_\mathrm{n})", "length"),
    "delta10": Symbol(
        "deflection of the released end under the unit force at the impact",
        r"\delta_{10}",
        "flexibility",
    ),
    "delta11": Symbol(
        "deflection of the released end under a unit force of its own",
        r"\delta_{11}",
        "flexibility",
    ),
    "Rt": Symbol("force at the top", r"R_\mathrm{t}", "share"),
    "Rb": Symbol("force at the base", r"R_\mathrm{b}", "share"),
    "Mt": Symbol("moment at the top", r"M_\mathrm{t}", "length"),
    "Mb": Symbol("moment at the base", r"M_\mathrm{b}", "length"),
    "Mn": Symbol("moment at the impact", r"M_\mathrm{n}", "length"),
    "xfb": Symbol("flexural deflection below the impact", r"x_\mathrm{f,b}", "flexibility"),
    "xft": Symbol("flexural deflection above the impact", r"x_\mathrm{f,t}", "flexibility"),
    "xs": Symbol("shear deflection", r"x_\mathrm{s}", "flexibility"),
    "xn": Symbol("deflection at the impact", r"x(z_\mathrm{n})", "flexibility"),
    "kp": Symbol("stiffness of the pier", r"k_\mathrm{p}", "stiffness"),
    **_shape("below", "b"),
    **_shape("above", "t"),
    "phi2": Symbol("integral over the column", r"\int_0^H \varphi^2 \, \mathrm{d}z", "length"),
    "mp": Symbol("equivalent mass of the pier", r"m_\mathrm{p}", "mass"),
    "fp": Symbol("frequency of the pier", r"f_\mathrm{p}", "frequency"),
    "cp": Symbol("damping coefficient of the pier", r"c_\mathrm{p}", "damping"),
    # The design procedure: pier and plateau forces
    "on_pier": Symbol("friction on the pier", r"\text{friction acts on the pier}"),
    "omega": Symbol("circular frequency of the pier", r"\omega_\mathrm{p}", "circular frequency"),
    "omega_d": Symbol(
        "damped circular frequency of the pier", r"\omega_\mathrm{d}", "circular frequency"
    ),
    "Q": Symbol("body plateau force on the pier", "Q", "force"),
    "Fpl": Symbol("total plateau force on the pier", r"F_\mathrm{pl}", "force"),
    "Rpl": Symbol(
        "plateau peak, the largest reaction to the plateaus alone", r"R_\mathrm{pl}", "force"
    ),
    "a1": Symbol("deceleration of the engine on its plateau", "a_1", "acceleration"),
    "Fb": Symbol("body resistance: the force that slows the body", r"F_\mathrm{b}", "force"),
    "a2": Symbol("deceleration of the body on its plateau", "a_2", "acceleration"),
    # Engine
    "t1_0": Symbol("time of engine contact if the pier stood still", "t_1'", "time"),
    "x1_0": Symbol("displacement of the pier at $t_1'$", "x_1'", "length"),
    "t1": Symbol("time of engine contact", "t_1", "time"),
    "x1": Symbol("displacement of the pier at $t_1$", "x_1", "length"),
    "dx1": Symbol("velocity of the pier at $t_1$", r"\dot x_1", "speed"),
    "v1": Symbol("contact speed of the engine; zero if it stops before", "v_1", "speed"),
    **_spectrum("engine", 1),
    "u1": Symbol("relative speed of engine and pier at contact", "u_1", "speed"),
    "Rv1": Symbol(
        "amplitude of the pier’s free vibration after the engine’s impact, as a reaction",
        r"R_{\mathrm{v}1}",
        "force",
    ),
    "R0": Symbol("plateau peak passed before engine contact", "R_0", "force"),
    "R1_0": Symbol("engine reaction if the cargo stays away", "R_1'", "force"),
    "R1": Symbol("engine reaction", "R_1", "force"),
    # Free vibration of the pier
    "mr": Symbol("reduced mass of engine and pier", r"m_\mathrm{r}", "mass"),
    "omega_r": Symbol(
        "circular frequency of the impact", r"\omega_\mathrm{r}", "circular frequency"
    ),
    "tbar": Symbol("centroid of the impact after contact", r"\bar t", "time"),
    "sigma_J": Symbol("spread of the impact about its centroid", r"\sigma_\mathrm{J}", "time"),
    "J": Symbol("impulse of the impact, as far as the pier feels it", "J", "impulse"),
    "tJ": Symbol("time from which the pier vibrates freely", r"t_\mathrm{J}", "time"),
    "xJ": Symbol(
        r"displacement of the pier at $t_\mathrm{J}$, from its rest under $Q$",
        r"x_\mathrm{J}",
        "length",
    ),
    "dxJ": Symbol(
        r"velocity of the pier at $t_\mathrm{J}$, after the impact", r"\dot x_\mathrm{J}", "speed"
    ),
    # Arrival of the cargo
    "t2_0": Symbol("time of cargo contact if the pier stood still", "t_2'", "time"),
    "x2_0": Symbol("displacement of the pier at $t_2'$", "x_2'", "length"),
    "t2": Symbol("time of cargo contact", "t_2", "time"),
    "x2": Symbol("displacement of the pier at $t_2$", "x_2", "length"),
    "dx2": Symbol("velocity of the pier at $t_2$", r"\dot x_2", "speed"),
    "v2": Symbol("contact speed of the cargo; zero if it stops before", "v_2", "speed"),
    "tc": Symbol("time of the maximum that follows the engine’s impact", r"t_\mathrm{c}", "time"),
    # Cargo
    **_spectrum("cargo", 2),
    "F2": Symbol(
        "rise of the cargo’s force above its plateau on a rigid pier", r"\hat F_2", "force"
    ),
    "Rv2": Symbol(
        "amplitude of the free vibration left when the cargo arrives, as a reaction",
        r"R_{\mathrm{v}2}",
        "force",
    ),
    "eta": Symbol("share of this amplitude that counts", r"\eta", "share"),
    "R2": Symbol("cargo reaction", "R_2", "force"),
    "x0": Symbol("displacement at which pier and cargo in contact would rest", "x_0", "length"),
    "gamma": Symbol("difference in frequency of pier and cargo", r"\gamma", "share"),
    "lam": Symbol("root of the modes", r"\lambda", "share"),
    "Lam": Symbol(r"sum of $\lambda$ and $\gamma$", r"\Lambda", "share"),
    **_mode("slow"),
    **_mode("fast"),
    "tu": Symbol(
        "time after contact at which the slow mode is largest and the spring turns to unloading",
        r"t_\mathrm{u}",
        "time",
    ),
    "w": Symbol("weight of the fast mode in the maximum of both modes", "w", "share"),
    "n": Symbol(r"whole periods of the fast mode before $t_\mathrm{u}$", "n", "share"),
    "ta": Symbol(
        r"time after contact of the last maximum of both modes before $t_\mathrm{u}$",
        r"t_\mathrm{a}",
        "time",
    ),
    "tb": Symbol(
        r"time after contact of the first maximum of both modes after $t_\mathrm{u}$",
        r"t_\mathrm{b}",
        "time",
    ),
    "xu": Symbol(r"displacement of the pier at $t_\mathrm{u}$", r"x_\mathrm{u}", "length"),
    "xa": Symbol(r"displacement of the pier at $t_\mathrm{a}$", r"x_\mathrm{a}", "length"),
    "xb": Symbol(
        r"displacement of the pier at $t_\mathrm{b}$; the spring unloads on $k_{\mathrm{u}2}$",
        r"x_\mathrm{b}",
        "length",
    ),
    # Results
    "R": Symbol("design reaction", "R", "force"),
    "R_D": Symbol("reaction of the design procedure", r"R_\mathrm{D}", "force"),
    "R_M": Symbol("governing peak of the full model", r"R_\mathrm{M}", "force"),
    "V_max": Symbol("largest shear", r"V_\mathrm{max}", "force"),
    "M_max": Symbol("largest moment", r"M_\mathrm{max}", "moment"),
    # The full model and the shape, where no step gives them
    "delta_i": Symbol("crush of a spring", r"\delta_i", "length"),
    "E_i": Symbol("envelope of a spring’s force", "E_i", "force"),
    "F_i": Symbol("force of a spring", "F_i", "force"),
    "F_f": Symbol("friction on the body", r"F_\mathrm{f}", "force"),
    "height": Symbol("height above the base", "z", "length"),
    "s": Symbol(
        "distance from the base or from the top, over the height of the column", "s", "share"
    ),
    "phi": Symbol("shape function", r"\varphi", "ordinate"),
}

#: Names, and the symbols themselves, by the keys of case files and truck files.
NAMES = {symbol.key: name for name, symbol in SYMBOLS.items() if symbol.key}
BY_KEY = {key: SYMBOLS[name] for key, name in NAMES.items()}


def dimension(symbol: Symbol) -> str:
    """Return the dimension that a value must have, of `units.DIMENSIONS`; "" for a plain number."""
    kinds = {"section length": "length", "modulus": "pressure", "strength": "pressure", "ratio": ""}
    return kinds.get(symbol.quantity, symbol.quantity)
