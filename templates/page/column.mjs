// A uniform column as the pier that a truck meets: stiffness and mass at the impact height.
//
// A unit force bends and shears the column (Timoshenko beam). From the base upward, below the force:
//
//   V = V0                      M = M0 + V0 z
//   θ = θ0 − ∫ M dz / EI        w = w0 + ∫ (θ + V / GA) dz
//
// and beyond it with the force taken from V. Base and top each give two conditions. Then the
// stiffness is kp = 1/w(zn), the shape φ = w/w(zn), and the mass the integral of ρA φ².

// Which of w, θ, M, V is zero at an end.
const ZERO = { fixed: [0, 1], pinned: [0, 2], free: [2, 3] };
// Points and weights of Gauss's rule, exact for polynomials up to the seventh power.
const GAUSS = [[0.8611363115940526, 0.34785484513745385], [0.3399810435848563, 0.6521451548625461]]
  .flatMap(([x, w]) => [[-x, w], [x, w]]);

/** Whether the ends leave the column a mechanism. */
export function isMechanism(base, top) {
  return base !== "fixed" && top !== "fixed" && (base === "free" || top === "free");
}

/**
 * The equivalent pier of a column of circular section.
 *
 * column: { diameter, height, impact, base, top, elasticModulus, shearModulus: that of the material
 *   times the share of the area in shear, density }, in SI units. Returns { stiffness, mass,
 *   shape(z): the shape function φ, shear: the share of the deflection that is shear's, whole: the
 *   mass of the column }.
 */
export function pierOf({ diameter, height, impact, base, top, elasticModulus, shearModulus, density }) {
  const area = (Math.PI * diameter ** 2) / 4, EI = (elasticModulus * Math.PI * diameter ** 4) / 64;
  const GA = shearModulus * area;

  /** The state w, θ, M, V at a height, from that at the base and a force at the impact. */
  function state([w0, t0, M0, V0], force, z) {
    const r = Math.max(z - impact, 0);
    return [
      w0 + t0 * z - (M0 * z ** 2 / 2 + V0 * z ** 3 / 6) / EI + (V0 * z) / GA + force * (r ** 3 / (6 * EI) - r / GA),
      t0 - (M0 * z + V0 * z ** 2 / 2) / EI + (force * r ** 2) / (2 * EI),
      M0 + V0 * z - force * r,
      V0 - (z > impact ? force : 0),
    ];
  }

  const [first, second] = [0, 1, 2, 3].filter((n) => !ZERO[base].includes(n));
  const unit = (n) => [0, 1, 2, 3].map((m) => Number(m === n));
  const [a, b] = [unit(first), unit(second)].map((start) => ZERO[top].map((n) => state(start, 0, height)[n]));
  const c = ZERO[top].map((n) => -state([0, 0, 0, 0], 1, height)[n]);
  const determinant = a[0] * b[1] - a[1] * b[0];
  const start = [0, 0, 0, 0];
  start[first] = (c[0] * b[1] - c[1] * b[0]) / determinant;
  start[second] = (a[0] * c[1] - a[1] * c[0]) / determinant;
  const w = (z) => state(start, 1, z)[0];
  const square = (from, to) => GAUSS.reduce(
    (sum, [x, weight]) => sum + 0.5 * (to - from) * weight * w(0.5 * (from + to) + 0.5 * (to - from) * x) ** 2, 0);
  const deflection = w(impact);
  // Shear's part by the work of a unit force, whose shear is V0 below it and V0 − 1 above.
  const sheared = (start[3] ** 2 * impact + (start[3] - 1) ** 2 * (height - impact)) / GA;
  return {
    shape: (z) => w(z) / deflection, shear: sheared / deflection, whole: density * area * height,
    stiffness: 1 / deflection,
    mass: (density * area * (square(0, impact) + square(impact, height))) / deflection ** 2,
  };
}
