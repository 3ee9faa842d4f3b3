# diptych: the equations of the manual, each with the words of the source that state it
# SPDX-License-Identifier: LGPL-2.1-or-later
"""An entry is (name, LaTeX, source file, words). The words stand in the comments of that file, but for line breaks and comment signs;
where they do not, the manual is not built: whoever changes a formula in the source changes it here, too."""

STEP, LAW, SPRINGS = "discrete/stepping/", "discrete/contacts/", "discrete/stepping/penalty.h"

GRAINS = [
    ("One step, theta = 1/2", r"q_m = q + \tfrac{h}{2} v,\qquad v_f = v + h M^{-1} F,\qquad v' = v_f + M^{-1} H r,\qquad q' = q_m + \tfrac{h}{2} v'",
     STEP + "time_stepping.h",
     "q_m = q + (h/2) v; contacts found there; v_f = v + h M^-1 F; impulses r solved; v' = v_f + M^-1 H r; q' = q_m + (h/2) v'"),
    ("Relative velocity of a contact", r"u_n = n\cdot(v_i - v_j),\qquad u_t = t\cdot(v_i - v_j) - s_i - s_j",
     LAW + "contact_problem.h", "u_n = n.(v_i - v_j), u_t = t.(v_i - v_j) - s_i - s_j."),
    ("Signorini's condition and Coulomb's law",
     r"0 \le u_n' + c_n \;\perp\; r_n \ge 0,\qquad |r_t| \le \mu r_n,\quad \text{sliding against } u_t' + e_t u_t",
     "discrete/README.md", "0 <= u_n' + c_n _|_ r_n >= 0, |r_t| <= mu r_n, sliding against u_t' + e_t u_t"),
    ("Normal term: impact or gap",
     r"c_n = e_n u_n \ \text{ for an impact},\qquad c_n = \max(g, 0)/h\ \text{ otherwise, so that } g + h u_n' \ge 0",
     STEP + "time_stepping.h", "c_n = e_n u_n for an impact (u_n < 0 and the gap is or would be closed), max(g, 0)/h otherwise"),
    ("Restitution and Moreau's weight", r"e_n = \frac{1 - w}{w}", STEP + "step_setting.h",
     "e_n = (1-w)/w of Moreau's weighted average velocity"),
    ("One contact for itself", r"r_n' = \max\!\left(0,\; r_n - \omega\,\frac{u_n + c_n}{W_{nn}}\right),\qquad "
     r"r_t' = \operatorname{clamp}\!\left(r_t - \omega\,\frac{u_t + c_t}{W_{tt}},\; \pm\mu r_n'\right)",
     LAW + "contact_law.h",
     "r_n' = max(0, r_n - omega (u_n + c_n)/W_nn), r_t' = r_t - omega (u_t + c_t)/W_tt clamped to +-mu r_n'."),
    ("Delassus operator of two discs", r"\frac{W_{nn}}{W_{tt}} = \frac13,\qquad \frac{r^2}{I} = \frac{2}{m}", LAW + "contact_law.h",
     "W_nn / W_tt of two discs, or of a disc and a body that nothing moves: r^2/I = 2/m adds twice each inverse mass."),
    ("Bodies eliminated", r"u = W r + q,\qquad W = H^T M^{-1} H", "discrete/problem_files/delassus_problem.h",
     "u = W r + q [length/time] with the laws 0 <= u_n _|_ r_n >= 0, |r_t| <= mu r_n, sliding against u_t. W = H^T M^-1 H is"),
    ("Residual: the natural map", r"\frac{\lVert r - P(r)\rVert_2}{\lVert r\rVert_2}", LAW + "natural_map.h",
     "Natural map ||r - P(r)||_2 / ||r||_2: P solves every contact for itself with its own W_nn and W_tt"),
    ("The error that Siconos reports", r"\frac{\lVert r - P_K\bigl(r - (u_n + \mu|u_t|,\, u_t)\bigr)\rVert_2}{\max(\lVert r\rVert, \lVert u\rVert, \lVert q\rVert)}",
     "discrete/problem_files/delassus_problem.h", "||r - P_K(r - (u_n + mu |u_t|, u_t))||_2 / max(||r||, ||u||, ||q||)"),
    ("First guess of a step", r"\sum \Delta r\cdot(u + c) = 0\ \text{ after }\ r + a\,\Delta r,\quad a\in[-1, 1]", STEP + "warm_start.h",
     "of the law does no work along the changes, sum change . (u + c) = 0 over what sticks or presses"),
    ("Reach of the detection, beside each grain", r"0.04\,d + 1.2\,h\left(|v| + \frac{h|F|}{m}\right)", STEP + "time_stepping.h",
     "Detection margin of a grain: 0.04 d + 1.2 h (|v| + h |F|/m)."),
    ("Correction of penetrations", r"0 \le g + h(u_n' + w_n) \;\perp\; r_n' \ge 0,\qquad |r_t'| \le \mu r_n',\qquad w = M^{-1}H(r' - r)",
     STEP + "position_correction.h", "0 <= g + h (u_n' + w_n) _|_ r_n' >= 0, |r_t'| <= mu r_n', sliding against w_t."),
    ("Energy of a step", r"\Delta E_{\mathrm{kin}} = W_{\mathrm{ext}} - D_{\mathrm{friction}} - D_{\mathrm{impact}},\qquad "
     r"\sum r\cdot\tfrac12(u + u')\ \text{ the work of the impulses}", STEP + "step_ledger.h",
     "kinetic_change = external_work - friction_dissipation - impact_dissipation to round-off, because momentum is balanced over "
     "the step: sum r.(u + u')/2 is the work of the impulses."),
    ("Containing action on free sides", r"\sum f_x = w\,P\ \text{ over the end grains of a band of height } w", "discrete/bodies/boundary.h",
     "grains on the left carry, in proportion to their masses, horizontal forces that total (height of the band) x pressure"),
    ("Inertia of a disc", r"I = \tfrac12 m r^2", "discrete/bodies/state.h", "I = m r^2 / 2 of a disc about its centre."),
]

STEP_LENGTH = [
    ("step = auto: forces", r"h \le 1\, d\sqrt{\rho/s}\ \text{ (free end grains)},\qquad h \le 5\, d\sqrt{\rho/s}", STEP + "step_rule.h",
     "forces 1 d sqrt(rho/s) with free end grains, 5 otherwise"),
    ("step = auto: gravity", r"h \le 0.3\sqrt{d/g}", STEP + "step_rule.h", "gravity 0.3 sqrt(d/g)"),
    ("step = auto: strength", r"h \le \frac{\text{accuracy}}{0.05/(d\sqrt{\rho/s}) + 55\,\dot\varepsilon},\qquad h \le 0.4\,d\sqrt{\rho/s}",
     STEP + "step_rule.h", "strength accuracy / (0.05 / (d sqrt(rho/s)) + 55 rate): what long steps add to the strength; at most 0.4 d sqrt(rho/s)"),
    ("What step and tolerance cost in strength", r"\frac{\Delta(T/S)}{T/S} = 0.05\,h + 55\,\dot\varepsilon h\qquad (h \text{ in } d\sqrt{\rho/s})",
     STEP + "step_rule.h", "strength 0.05 h + 55 x (strain per step)"),
    ("What they cost in dilation", r"(0.2 + 0.8\,h)\;\text{tolerance}\;\frac{h}{I}\left(\frac{N}{1000}\right)^{0.75}", STEP + "step_rule.h",
     "dilation (0.2 + 0.8 h) x tolerance x h / I x (grains / 1000)^0.75 from 1000 grains on"),
    ("Error of the stress of single grains", r"E = 4\,\frac{D_k\,q}{1 - q},\qquad D_k = \frac{\lVert M(2^k) - M(2^{k-1})\rVert}{\lVert M(2^k)\rVert}",
     STEP + "grain_stress_error.h", "E = 4 D_k q / (1 - q), unknown (infinity) for q >= 0.9"),
]

PENALTY = [
    ("Springs, dashpots, friction", r"f_n = \max\!\left(0,\, -k_n g - 2\beta\sqrt{k_n m_{\mathrm{eff}}}\,u_n\right),\qquad "
     r"f_t = \operatorname{clamp}\!\left(f_t^{\text{last}} - \tfrac{k_n}{2} h u_t,\; \pm\mu f_n\right)", SPRINGS,
     "f_n = max(0, -kn g - 2 beta sqrt(kn m_eff) u_n), f_t = f_t of the last step - (kn/2) h u_t clamped to +-mu f_n;"),
    ("Step of the springs", r"h = \text{fraction}\cdot\sqrt{m_{\min}/k_n}", SPRINGS, "Step fraction x sqrt(m_min / stiffness)"),
]

MOMENTS = [
    ("Internal moment of a grain", r"M_i = -\operatorname{sym}\sum_c (x_c - x_i)\otimes f_c - \tfrac12\,\omega_i^2 I_i\,\mathbf 1",
     LAW + "internal_moment.h", "M_i = -sym sum_c (x_c - x_i) (x) f_c - (1/2) omega_i^2 I_i 1, summed over the contacts of grain i"),
    ("Mean stress, shear stress, mobilised friction", r"s = \frac{s_1 + s_2}{2},\qquad t = \frac{s_1 - s_2}{2},\qquad \frac{t}{s} = \sin\varphi_m",
     LAW + "internal_moment.h", "s = (s1 + s2)/2, t = (s1 - s2)/2, t/s = sin of the mobilised friction angle."),
]

AVERAGING = [
    ("segments: branches cut by the mesh", r"|K|\,\sigma_K = -\sum_c f_c \otimes (\text{segment of the branch in } K)",
     "coupling/averaging/segments.h", "|K| sigma_K = -sum_c f (x) (segment in K)"),
    ("Nothing is lost", r"\sum_K |K|\,\sigma_K = -\sum_c f_c\otimes\ell_c", "coupling/averaging/segments.h",
     "sum_K |K| sigma_K = total to round-off."),
    ("Nodal identity", r"\sum_K |K|\,\sigma_K\nabla N_a = \sum_i N_a(x_i)\,(m_i a_i - F_i) - \sum_{\text{platens}} N_a(x_c)\,f",
     "coupling/averaging/segments.h", "sum_i N_a(x_i) (m_i a_i - F_i) - sum_platens N_a(x_c) f, with F_i the containing action and gravity."),
    ("Spin term", r"\sigma^{\text{spin}}|K| = -\sum_{i\in K}\tfrac12\,\overline{\omega_i^2} I_i\,\mathbf 1", "coupling/averaging/segments.h",
     "spin_term = mean of (1/2) omega^2 I >= 0"),
    ("kernel = gauss", r"\phi(r) = \frac{e^{-r^2/2w^2}}{2\pi w^2}\qquad (r < 4w)", "coupling/averaging/kernel.h",
     "gauss: exp(-r^2 / 2 w^2) / (2 pi w^2), cut at 4 w"),
    ("kernel = lucy", r"\phi(r) = \frac{5}{\pi R^2}\left(1 + 3\frac rR\right)\left(1 - \frac rR\right)^3,\qquad R = \sqrt{56/5}\;w",
     "coupling/averaging/kernel.h", "lucy: 5 / (pi R^2) (1 + 3 r/R) (1 - r/R)^3 for r < R (Lucy 1977)"),
    ("projection", r"(M + l^2 K)\,c_a = \sum \text{quantities}\times N_a,\qquad l = w/\sqrt2", "coupling/averaging/averaging.h",
     "projection: integrals over the cells of c, (M + l^2 K) c_a = sum of the quantities x N_a"),
    ("laguerre: power cells", r"x \text{ belongs to the disc } i \text{ with the least } |x - x_i|^2 - r_i^2", "coupling/averaging/power_cells.h",
     "Points x of the box with |x - x_i|^2 - r_i^2 least for disc i"),
    ("Stress at a point", r"\sigma(x) = \frac{-\sum f\otimes\int_{\text{half branch}}\phi}{\int_{\text{mesh}}\phi}", "coupling/averaging/point_stress.h",
     "sum over the half branches of -f (x) (integral of phi along it) over the integral of phi over the mesh"),
    ("Couple stress of the grains", r"|K|\,\mu_K = -\sum_c\int_{\text{branch in }K}\bigl((x_c - x)\times f\bigr)\,ds", "coupling/fields/fields.h",
     "|K| mu_K = -sum_c integral over the branch in K of ((x_c - x) x f) ds"),
    ("Velocity and granular temperature", r"\bar v = \frac{\langle m v\rangle}{\langle m\rangle},\qquad "
     r"T = \frac{\langle m|v'|^2/2\rangle}{\langle m\rangle}", "coupling/fields/fields.h",
     "velocity = <m v> / <m>; granular temperature = <m |v'|^2 / 2> / <m>"),
    ("Number of grains that a mean joins", r"n = \frac{(\sum_i \alpha_i)^2}{\sum_i\alpha_i^2}", "coupling/averaging/carriers.h",
     "(sum of the shares of grains)^2 / sum of their squares"),
    ("Strain increment", r"\varepsilon_1 - \varepsilon_2\ \text{ of }\ \operatorname{sym} G,\qquad G_{kl} = \frac{\partial u_k}{\partial x_l}",
     "coupling/fields/strain_increment.h", "Gradient of the displacement increment around each sample point, G_kl = d u_k / d x_l"),
]

BANDS = [
    ("A band in the displacements", r"u = c + G(x - x_0) + \tfrac12 J\tanh\frac{n\cdot(x - x_0) - o}{\delta}", "coupling/bands/band.h",
     "u = c + G (x - centre) + (J/2) tanh((n.(x - centre) - offset) / half_width)"),
    ("What the fit minimises", r"\sum w\,\rho\Bigl(\bigl|u - c - Gx - \sum_b a_b\tanh\tfrac{n_b\cdot x - o_b}{\delta_b}\bigr|\Bigr)",
     "coupling/bands/band_fit.h", "Minimises sum w rho(|u - c - G x - sum_b a_b tanh((n_b.x - o_b)/delta_b)|), rho of Huber"),
    ("Number of bands: BIC", r"\mathrm{BIC} = n\ln s^2 + p\ln n,\qquad p = 6 + 5\times\text{bands}", "coupling/bands/band_detection.cc",
     "BIC = n log(variance) + p log(n); p = 6 affine coefficients and 5 for each band"),
    ("Too weak to be a band", r"\frac{|J|}{2\delta} < \frac{\text{travel}}{\text{height}}", "coupling/bands/band_detection.h",
     "jump / (2 half width) < platen increment / height"),
    ("Correlation assumed for the intervals", r"\varrho(r) = e^{-\pi r^2/L^2}", "coupling/bands/band_calibration.h", "correlation exp(-pi r^2/L^2)"),
    ("Coulomb's line", r"\theta = 45^\circ + \varphi/2", "coupling/bands/theory_lines.h", "45 + phi/2: plane of greatest stress obliquity"),
    ("Roscoe's line", r"\theta = 45^\circ + \psi/2", "coupling/bands/theory_lines.h", "45 + psi/2: line of no extension (Roscoe 1970)"),
    ("Arthur's line", r"\theta = 45^\circ + (\varphi + \psi)/4", "coupling/bands/theory_lines.h", "45 + (phi + psi)/4"),
]
