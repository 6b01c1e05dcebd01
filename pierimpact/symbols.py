"""Every quantity once: its symbol, what kind of quantity it is, and what it means.

Case files, truck files, the sheet with its nomenclature, the domain of the study and the
explorers read from here. The names are those of the calculations in `pier` and `design`.
"""

from collections.abc import Iterator
from typing import NamedTuple

# Name | symbol in LaTeX | kind, of `units.QUANTITIES` | meaning | key in case and truck files.
# The symbol is empty for what is only spoken of, the kind for a word.
_TABLE = r"""
# The column
column_shape |  |  | shape of the section | column_shape
base |  |  | base of the column | base
top |  |  | top of the column | top
D | D | section length | column diameter | column_diameter
b | b | section length | column width, across the travel | column_width
h | h | section length | column depth, along the travel | column_depth
t | t | section length | wall thickness | column_wall_thickness
ns | n_\mathrm{s} | ratio | number of sides of the column | column_sides
Df | D_\mathrm{f} | section length | column width across flats | column_across_flats
A | A | area | area | column_area
I | I | second moment | second moment of area | column_second_moment
Av | A_\mathrm{v} | area | shear area | column_shear_area
alpha_E | \alpha_\mathrm{E} | ratio | elastic modulus of the steel over that of the concrete | modular_ratio
alpha_rho | \alpha_\rho | ratio | density of the steel over that of the concrete | density_ratio
H | H | length | column height | column_height
E | E | modulus | elastic modulus | elastic_modulus
fc | f_\mathrm{c}' | strength | concrete strength | concrete_strength
nu | \nu | ratio | Poisson’s ratio | poisson_ratio
rho | \rho | density | density | density
psi | \psi | ratio | share of the gross flexural rigidity that is effective | stiffness_factor
EIe | EI_\mathrm{eff} | flexural rigidity | effective flexural rigidity, as given | effective_stiffness

kb | k_\mathrm{b} | stiffness | lateral stiffness at the base | base_stiffness
krb | k_{\theta\mathrm{b}} | rotational stiffness | rotational stiffness at the base | base_rotation_stiffness
kt | k_\mathrm{t} | stiffness | lateral stiffness at the top | top_stiffness
krt | k_{\theta\mathrm{t}} | rotational stiffness | rotational stiffness at the top | top_rotation_stiffness
mt | m_\mathrm{t} | mass | mass at the top | top_mass
He | H_\mathrm{e} | length | equivalent depth of fixity below the base | embedment

# The collision
m | m_1 + m_2 | mass | total mass of the truck | truck_mass
V | V | speed | speed at first touch | speed
z | z_\mathrm{n} | length | nominal impact height | impact_height
zeta | \zeta | ratio | damping ratio of the pier | damping_ratio
V_R | V_\mathrm{R} | force | shear resistance | shear_resistance
M_R | M_\mathrm{R} | moment | moment resistance | moment_resistance

# The traffic
N_v | N | traffic volume | traffic volume past the pier | traffic_volume
p_t | p_\mathrm{T} | ratio | share of trucks in the traffic | truck_share
d_r | d | length | distance from the edge of the road | distance_from_road
b_e | b_\mathrm{e} | length | width that the pier offers across the course of a truck, with the truck’s own | exposed_width
lam_e | \lambda_\mathrm{e} | encroachment rate | chance of leaving the road toward the pier | encroachment_rate
mu_m | \mu_m | mass | mean mass of the trucks
mu_V | \mu_V | speed | mean speed of the trucks
R_R | R_\mathrm{R} | force | resistance, as a reaction
risk_pier |  |  | frequency of the pier, of 8 t
traffic_mass |  |  | masses of the trucks that pass | traffic_mass
traffic_speed |  |  | speeds of the trucks on the road | traffic_speed
traffic_deceleration |  |  | decelerations of the trucks off the road | traffic_deceleration
traffic_angle |  |  | angles at which trucks leave the road | traffic_angle

# The truck
m1 | m_1 | mass | engine mass | engine_mass
m2 | m_2 | mass | mass of body and cargo | body_mass
cs | c_\mathrm{s} | force | friction force on the body | friction_force
friction_on |  |  | friction acts against the | friction_on
P1 | P_1 | force | plateau force of the engine spring | engine_spring.plateau_force
d1 | d_1 | length | plateau length of the engine spring | engine_spring.plateau_length
k1 | k_1 | stiffness | steep stiffness of the engine spring | engine_spring.stiffness
ku1 | k_{\mathrm{u}1} | stiffness | unloading stiffness of the engine spring | engine_spring.unloading_stiffness
P2 | P_2 | force | plateau force of the body spring | body_spring.plateau_force
d2 | d_2 | length | plateau length of the body spring | body_spring.plateau_length
k2 | k_2 | stiffness | steep stiffness of the body spring | body_spring.stiffness
ku2 | k_{\mathrm{u}2} | stiffness | unloading stiffness of the body spring | body_spring.unloading_stiffness

# Section and equivalent pier
Di | D_\mathrm{i} | section length | inner diameter
bi | b_\mathrm{i} | section length | inner width
hi | h_\mathrm{i} | section length | inner depth
r | r | section length | radius of the round ends
c | c | section length | length of the straight sides
ls | \ell | section length | length of a side
Ac | A_\mathrm{c} | area | area of the concrete
As | A_\mathrm{s} | area | area of the steel
Am | A_\mathrm{m} | area | area of the same mass in concrete
Ic | I_\mathrm{c} | second moment | second moment of area of the concrete
Is | I_\mathrm{s} | second moment | second moment of area of the steel
Sf | S_\mathrm{f} | first moment | first moment of area of a flange or a round end
U | U | shear integral | integral of $S^2/b$ over the depth, $b$ being the width
Uw | U_\mathrm{w} | shear integral | integral of $S^2/b$ over the webs or the straight sides
Uf | U_\mathrm{f} | shear integral | integral of $S^2/b$ over the flanges or the round ends
Uh | U_\mathrm{h} | shear integral | integral of $S^2/b$ along the flanges, $b$ being their thickness
kappa_s | \kappa_\mathrm{s} | share | shear coefficient of the steel
kappa | \kappa | share | shear coefficient
EI | EI | flexural rigidity | flexural rigidity
G | G | modulus | shear modulus
GA | \kappa GA | shear rigidity | shear rigidity
mbar | \bar m | mass per length | mass per length
y | (H - z_\mathrm{n}) | length | height of the top above the impact
delta10 | \delta_{10} | flexibility | deflection of the released end under the unit force at the impact
delta11 | \delta_{11} | flexibility | deflection of the released end under a unit force at that end
Rt | R_\mathrm{t} | share | support force at the top under the unit force
Rb | R_\mathrm{b} | share | support force at the base under the unit force
Mt | M_\mathrm{t} | length | moment at the top under the unit force
Mb | M_\mathrm{b} | length | moment at the base under the unit force
Mn | M_\mathrm{n} | length | moment at the impact under the unit force
xfb | x_\mathrm{f,b} | flexibility | flexural deflection below the impact
xft | x_\mathrm{f,t} | flexibility | flexural deflection above the impact
xs | x_\mathrm{s} | flexibility | shear deflection
xn | x(z_\mathrm{n}) | flexibility | deflection at the impact under the unit force
kp | k_\mathrm{p} | stiffness | stiffness of the pier
sb | s_\mathrm{b} | share | distance of the impact from the base, over the height
cb0 | c_\mathrm{b0} | share | shape below the impact, constant
cb1 | c_\mathrm{b1} | share | shape below the impact, coefficient of $s$
cb2 | c_\mathrm{b2} | share | shape below the impact, coefficient of $s^2$
cb3 | c_\mathrm{b3} | share | shape below the impact, coefficient of $s^3$
phi2b | \int_0^{z_\mathrm{n}} \varphi^2 \, \mathrm{d}z | length | integral of $\varphi^2$ below the impact
st | s_\mathrm{t} | share | distance of the impact from the top, over the height
ct0 | c_\mathrm{t0} | share | shape above the impact, constant
ct1 | c_\mathrm{t1} | share | shape above the impact, coefficient of $s$
ct2 | c_\mathrm{t2} | share | shape above the impact, coefficient of $s^2$
ct3 | c_\mathrm{t3} | share | shape above the impact, coefficient of $s^3$
phi2t | \int_{z_\mathrm{n}}^H \varphi^2 \, \mathrm{d}z | length | integral of $\varphi^2$ above the impact
phi2 | \int_0^H \varphi^2 \, \mathrm{d}z | length | integral of $\varphi^2$ over the column
mp | m_\mathrm{p} | mass | equivalent mass of the pier
fp | f_\mathrm{p} | frequency | natural frequency of the pier
cp | c_\mathrm{p} | damping | damping coefficient of the pier

# The design procedure: pier and plateau forces
on_pier | \text{friction acts on the pier} |  | friction on the pier
omega | \omega_\mathrm{p} | circular frequency | natural circular frequency of the pier
omega_d | \omega_\mathrm{d} | circular frequency | damped circular frequency of the pier
Q | Q | force | force of the body’s plateau on the pier
Fpl | F_\mathrm{pl} | force | total plateau force on the pier
Rpl | R_\mathrm{pl} | force | plateau peak: reaction to the plateaus alone
a1 | a_1 | acceleration | deceleration of the engine on its plateau
Fb | F_\mathrm{b} | force | retarding force on the body
a2 | a_2 | acceleration | deceleration of the body on its plateau

# Engine
t1_0 | t_1' | time | time of engine contact if the pier stood still
x1_0 | x_{\mathrm{p}1}' | length | displacement of the pier at $t_1'$
t1 | t_1 | time | time of engine contact
x1 | x_{\mathrm{p}1} | length | displacement of the pier at $t_1$
dx1 | \dot x_{\mathrm{p}1} | speed | velocity of the pier at $t_1$
v1 | v_1 | speed | contact speed of the engine, zero if it stops
beta1 | \beta_1 | share | frequency ratio of pier to engine
mu1 | \mu_1 | share | mass ratio of engine to pier
e1 | e_1 | share | coefficient of restitution, engine
h1 | h_1 | share | resonance term of the spectrum, engine
S1 | S_1 | share | amplification factor, engine
u1 | u_1 | speed | relative speed of engine and pier at contact
Rv1 | R_{\mathrm{v}1} | force | peak reaction above $Q$ after the engine’s impact
R0 | R_0 | force | plateau peak, if reached before engine contact
R1_0 | R_1' | force | engine reaction without cargo contact
R1 | R_1 | force | engine reaction

# Free vibration of the pier
mr | m_\mathrm{r} | mass | reduced mass of engine and pier
omega_r | \omega_\mathrm{r} | circular frequency | circular frequency of the impact
tbar | \bar t | time | time from contact to the centroid of the impact force
sigma_J | \sigma_\mathrm{J} | time | standard deviation in time of the impact force about its centroid
J | J | impulse | effective impulse of the impact on the pier
tJ | t_\mathrm{J} | time | time from which the pier vibrates freely
xJ | x_\mathrm{pJ} | length | displacement of the pier at $t_\mathrm{J}$, from its rest under $Q$
dxJ | \dot x_\mathrm{pJ} | speed | velocity of the pier at $t_\mathrm{J}$, after the impact

# Arrival of the cargo
t2_0 | t_2' | time | time of cargo contact if the pier stood still
x2_0 | x_{\mathrm{p}2}' | length | displacement of the pier at $t_2'$
t2 | t_2 | time | time of cargo contact
x2 | x_{\mathrm{p}2} | length | displacement of the pier at $t_2$
dx2 | \dot x_{\mathrm{p}2} | speed | velocity of the pier at $t_2$
v2 | v_2 | speed | contact speed of the cargo, zero if it stops
tc | t_\mathrm{c} | time | time of the first maximum after the engine’s impact

# Cargo
beta2 | \beta_2 | share | frequency ratio of pier to cargo
mu2 | \mu_2 | share | mass ratio of cargo to pier
e2 | e_2 | share | coefficient of restitution, cargo
h2 | h_2 | share | resonance term of the spectrum, cargo
S2 | S_2 | share | amplification factor, cargo
F2 | \hat F_2 | force | rise of the cargo’s force on a rigid pier
Rv2 | R_{\mathrm{v}2} | force | the same, decayed until the cargo arrives
eta | \eta | share | share of $R_{\mathrm{v}2}$ added to the cargo reaction
R2 | R_2 | force | cargo reaction
x0 | x_0 | length | static part of the displacement in contact with the cargo
gamma | \gamma | share | auxiliary value of the eigenvalue equation of pier and cargo
lam | \lambda | share | root of the eigenvalue equation
Lam | \Lambda | share | sum of $\lambda$ and $\gamma$
omega_s | \omega_\mathrm{s} | circular frequency | slow mode: circular frequency
psi_s | \psi_\mathrm{s} | share | slow mode: ratio of the body’s to the pier’s displacement
sigma_s | \sigma_\mathrm{s} | decay rate | slow mode: decay rate
a_s | a_\mathrm{s} | length | slow mode: cosine amplitude
b_s | b_\mathrm{s} | length | slow mode: sine amplitude
X_s | X_\mathrm{s} | length | slow mode: amplitude
phi_s | \varphi_\mathrm{s} | angle | slow mode: phase
theta_s | \theta_\mathrm{s} | angle | slow mode: angle of the first maximum, from 0 to 2π
omega_f | \omega_\mathrm{f} | circular frequency | fast mode: circular frequency
psi_f | \psi_\mathrm{f} | share | fast mode: ratio of the body’s to the pier’s displacement
sigma_f | \sigma_\mathrm{f} | decay rate | fast mode: decay rate
a_f | a_\mathrm{f} | length | fast mode: cosine amplitude
b_f | b_\mathrm{f} | length | fast mode: sine amplitude
X_f | X_\mathrm{f} | length | fast mode: amplitude
phi_f | \varphi_\mathrm{f} | angle | fast mode: phase
theta_f | \theta_\mathrm{f} | angle | fast mode: angle of the first maximum, from 0 to 2π
tu | t_\mathrm{u} | time | time from cargo contact to the slow mode’s maximum, taken as the start of unloading
w | w | share | weight of the fast mode in the time of the combined maximum
n | n | share | complete periods of the fast mode before $t_\mathrm{u}$
ta | t_\mathrm{a} | time | time from cargo contact to the last combined maximum before $t_\mathrm{u}$
tb | t_\mathrm{b} | time | time from cargo contact to the first combined maximum after $t_\mathrm{u}$
xu | x_\mathrm{pu} | length | displacement of the pier at $t_\mathrm{u}$
xa | x_\mathrm{pa} | length | displacement of the pier at $t_\mathrm{a}$
xb | x_\mathrm{pb} | length | displacement of the pier at $t_\mathrm{b}$; the spring unloads on $k_{\mathrm{u}2}$

# Results
R | R_\mathrm{d} | force | design reaction
V_max | V_\mathrm{max} | force | largest shear
M_max | M_\mathrm{max} | moment | largest moment
Ry | R_\mathrm{y} | force | yield reaction

# The full model and the shape, where no step gives them
delta_i | \delta_i | length | crush of a spring
E_i | E_i | force | envelope of a spring’s force
F_i | F_i | force | force of a spring
F_f | F_\mathrm{f} | force | friction on the body
height | z | length | height above the ground
x_i | x_i | length | displacement of engine (i = 1) or body (i = 2)
x_p | x_\mathrm{p} | length | displacement of the pier at the impact height
R_t | R | force | reaction $k_\mathrm{p} x_\mathrm{p}$
s | s | share | distance from the base or from the top, over the height of the column
phi | \varphi | ordinate | shape function
"""


class Symbol(NamedTuple):
    """A quantity as it is printed and spoken of."""

    latex: str  #: symbol
    quantity: str  #: kind
    meaning: str  #: as within a sentence; mathematics between dollar signs
    key: str = ""  #: name in a case file or a truck file

    @property
    def heading(self) -> str:
        """The meaning as it begins a line."""
        return self.meaning[:1].upper() + self.meaning[1:]


def _rows() -> Iterator[tuple[str, Symbol]]:
    for line in _TABLE.splitlines():
        if line and not line.startswith("#"):
            name, *cells = (cell.strip() for cell in line.split("|"))
            yield name, Symbol(*cells)


SYMBOLS = dict(_rows())
#: Names, and the symbols themselves, by the keys of case files and truck files.
NAMES = {symbol.key: name for name, symbol in SYMBOLS.items() if symbol.key}
BY_KEY = {key: SYMBOLS[name] for key, name in NAMES.items()}


def dimension(symbol: Symbol) -> str:
    """Return the dimension that a value must have, of `units.DIMENSIONS`; "" for a plain number."""
    kinds = {"section length": "length", "modulus": "pressure", "strength": "pressure", "ratio": ""}
    return kinds.get(symbol.quantity, symbol.quantity)
