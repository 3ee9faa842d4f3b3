# diptych: return mapping of local and Cosserat laws, written from their equations alone
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elasto-plastic laws at many points at once, tension positive, after the equations in README.md.

Strain of a point: (e_xx, e_yy, gamma), Cosserat laws also (chi, k_x, k_y). The state is p and q, see README.md: the
in-plane stress is A^T q / G - p on the diagonal, where A maps a strain to the elastic change of q."""
import numpy

TINY = 1e-30  # Complex step: exact derivatives without subtraction.


class Law:
    """Law of `keys`, a dictionary of the section continuum; stresses in units of the pressure."""

    def __init__(self, keys):
        self.name = keys["law"]
        self.cosserat, self.plane = self.name.startswith("cosserat"), self.name.endswith("coulomb")
        young, poisson = float(keys["youngs_modulus"]), float(keys["poisson_ratio"])
        self.shear = shear = young / (2 * (1 + poisson))
        self.bulk = young / (3 * (1 - 2 * poisson)) + (shear / 3 if self.plane else 0)
        self.viscosity = float(keys.get("viscosity", 0))
        self.softening = float(keys["softening_strain"])
        self.mobilised = keys["hardening"] == "mobilisation"
        if self.mobilised:
            self.deficit = numpy.radians(float(keys["friction_angle_peak"]) - float(keys["friction_angle_start"]))
            self.mobilisation = float(keys["mobilisation_strain"])
        self.cohesion = float(keys["cohesion"])
        self.friction, self.dilatancy = ([numpy.radians(float(keys[f"{name}_angle_{end}"]))
                                          for end in ("peak", "residual")]
                                         for name in ("friction", "dilatancy"))
        rows = [(1, -1, 0), (0, 0, 1)] + ([] if self.plane else [(-1 / numpy.sqrt(3), ) * 2 + (0, )])
        self.to_q = shear * numpy.array(rows, dtype=float)
        self.skew = None
        if self.cosserat:
            length = numpy.sqrt(2) * float(keys["internal_length"])
            self.to_q = numpy.pad(self.to_q, ((0, 2), (0, 3)))
            self.to_q[-2:, -2:] = shear * length * numpy.eye(2)
            self.skew = float(keys["couple_shear_ratio"]) * shear
        self.n_strains = self.to_q.shape[1]
        self.trace = numpy.array([1, 1] + [0] * (self.n_strains - 2), dtype=float)

    def coefficients(self, kappa):
        """(f, d, g) of F = |q| - p f - g and of the plastic change K d lambda of p; kappa may be complex."""
        decay = numpy.exp(-kappa / self.softening)
        phi, psi = (residual + (peak - residual) * decay for peak, residual in (self.friction, self.dilatancy))
        if self.mobilised:
            phi = phi - self.deficit * numpy.exp(-kappa / self.mobilisation)
        sine = numpy.sin(phi)
        if self.plane:
            return sine, numpy.sin(psi), self.cohesion * numpy.cos(phi)
        beta = numpy.sin(psi) / numpy.sqrt(9 + 3 * numpy.sin(psi)**2)
        root = numpy.sqrt(1 - 3 * beta**2)
        alpha = sine / (3 * (root + beta * sine))
        return 3 * alpha, 3 * beta, self.cohesion * numpy.cos(phi) * (1 - 3 * alpha * beta) / root

    def yield_function(self, multiplier, size, pressure, kappa, progress):
        """(F, |q|, p, kappa) at the end of a step with the trial state (size, pressure); kappa: at its start. At the
        tip |q| = 0, where the plastic shear is |q| of the trial state / G and the rest of the multiplier only changes
        p."""
        length = size - self.shear * multiplier
        sheared = numpy.where(length.real > 0, multiplier, size / self.shear)
        length = numpy.where(length.real > 0, length, 0)
        f, d, g = self.coefficients(kappa + sheared)
        p = pressure + self.bulk * d * multiplier
        return length - p * f - g - self.viscosity / progress * sheared, length, p, kappa + sheared

    def multipliers(self, size, pressure, kappa, progress):
        """Plastic multipliers of points beyond the surface by Newton's method. Throws ArithmeticError."""
        found = numpy.zeros_like(size)
        for _ in range(60):
            value = self.yield_function(found + 1j * TINY, size, pressure, kappa, progress)[0]
            change = -value.real / (value.imag / TINY)
            found = numpy.maximum(found + change, 0)
            if numpy.all(abs(value.real) < 1e-13 * (1 + abs(pressure) + size)):
                return found
        raise ArithmeticError("a return mapping did not converge")

    def step(self, state, strain, progress):
        """State at the end of a step, in-plane stress[n, s] and tangent[n, s, s] for the strain increments strain[n,
        s]. state: dictionary of p[n], q[n, ...], kappa[n] and skew[n]."""
        q, p = state["q"] + strain @ self.to_q.T, state["p"] - self.bulk * (strain @ self.trace)
        size = numpy.sqrt((q**2).sum(axis=1))
        kappa = state["kappa"]
        multiplier = numpy.zeros_like(p)
        yields = self.yield_function(multiplier, size, p, kappa, progress)[0] > 0
        multiplier[yields] = self.multipliers(size[yields], p[yields], kappa[yields], progress)
        nudge = 1j * TINY
        trials = (multiplier + nudge, size, p), (multiplier, size + nudge, p), (multiplier, size, p + nudge)
        slopes = [[part.imag / TINY for part in self.yield_function(*trial, kappa, progress)] for trial in trials]
        (f_m, length_m, p_m, _), (f_s, length_s, p_s, _), (f_p, _, p_p,
                                                           _) = (numpy.array(part)[:, :, None] for part in slopes)
        _, length, end_p, end_kappa = self.yield_function(multiplier, size, p, kappa, progress)
        direction, share = q / numpy.where(size > 0, size, 1)[:, None], numpy.where(size > 0, length / size, 1)
        d_size, d_pressure = direction @ self.to_q, -self.bulk * self.trace
        d_multiplier = numpy.where(yields[:, None], -(f_s * d_size + f_p * d_pressure) / f_m, 0)
        d_length = length_s * d_size + length_m * d_multiplier
        d_p = p_s * d_size + p_p * d_pressure + p_m * d_multiplier
        d_q = (share[:, None, None] * (self.to_q - direction[:, :, None] * d_size[:, None, :])
               + direction[:, :, None] * d_length[:, None, :])
        end = {"p": end_p, "q": share[:, None] * q, "kappa": end_kappa, "skew": state["skew"]}
        tangent = numpy.einsum("ks,nkt->nst", self.to_q / self.shear, d_q) - self.trace[:, None] * d_p[:, None, :]
        stress = end["q"] @ self.to_q / self.shear - end["p"][:, None] * self.trace
        if self.cosserat:
            end["skew"] = state["skew"] + self.skew * strain[:, 3]
            stress[:, 3] += end["skew"]
            tangent[:, 3, 3] += self.skew
        return end, stress, tangent
