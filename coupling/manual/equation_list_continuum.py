# diptych: the equations of the continuum, of statistics and of what is built on them, for the manual
# SPDX-License-Identifier: LGPL-2.1-or-later
"""As equation_list.py."""

LAWS, STATISTICS = "continuum/laws/", "coupling/statistics/"

CONTINUUM = [
    ("Equilibrium", r"\sum_{\text{cells}}\int B^T\sigma\,dA = \text{side pressure} + \text{weight} + \text{reactions}",
     "continuum/equilibrium/boundary_value_problem.h", "sum over cells of int B^T sigma dA = side pressure + weight + reactions"),
    ("Side pressure", r"f_a = \pm p\int N_a\,dy", "continuum/equilibrium/loads.h", "f_a = +-p int N_a dy along both sides at the given shape"),
    ("Weight", r"f_a = \int N_a\,b\,dA", "continuum/equilibrium/loads.h", "f_a = int N_a b dA over the shape of `geometry`"),
    ("Mean dilation (q1_bbar)", r"\Delta\varepsilon_{xx} = \Delta\varepsilon_{yy} = d\cdot u,\qquad d = \tfrac12(\overline{\nabla N} - \nabla N)",
     "continuum/elements/element_kernels.h", "Mean dilation adds d . u to both normal strains, d = (mean gradient - gradient)/2"),
    ("Relative rotation of a Cosserat point", r"\chi = \left(\frac{\partial u_y}{\partial x} - \frac{\partial u_x}{\partial y}\right) - 2\omega",
     LAWS + "law.h", "relative rotation chi = (du_y/dx - du_x/dy) - 2 omega"),
    ("Skew stress", r"\sigma_{xy} = \sigma_{(xy)} - a,\qquad \sigma_{yx} = \sigma_{(xy)} + a", LAWS + "law.h",
     "s_xy = symmetric - a and s_yx = symmetric + a."),
    ("Elasticity in the plane", r"\sigma = \left(K + \tfrac G3\right)\operatorname{tr}(\varepsilon)\,\mathbf 1 + 2G\operatorname{dev}\varepsilon",
     LAWS + "elasticity.h", "In the plane: stress = plane_bulk tr(strain) 1 + 2 shear dev(strain) with the two-dimensional deviator."),
    ("Cosserat moduli", r"m = 2Gl^2\,\nabla\omega,\qquad a = G_c\,\chi", LAWS + "elasticity.h", "M = 2 G l^2: m = M curvature"),
    ("Deviator as a vector", r"q = \left(\tfrac12(\sigma_{xx} - \sigma_{yy}),\; \sigma_{xy},\; \tfrac{\sqrt3}{2}\sigma_{zz}',\; \tfrac{m_x}{\sqrt2\,l},\; \tfrac{m_y}{\sqrt2\,l}\right)",
     LAWS + "cone_law.h", "q = ((s_xx - s_yy)/2, s_xy, (sqrt3/2) s_zz', m_x/(sqrt2 l), m_y/(sqrt2 l)),"),
    ("Yield function of all cones", r"F = |q| - s f - g_0 = \text{overstress}", LAWS + "cone_law.h",
     "Implicit: F = |q| - s f - g0 = overstress with f, g0 and dilation d at the END of the step"),
    ("Mohr-Coulomb", r"F = t - s\sin\varphi - c\cos\varphi,\qquad g = t - s\sin\psi", LAWS + "mohr_coulomb.h",
     "F = t - s sin(phi) - c cos(phi), t and s of the two outer principal stresses, g = t - s sin(psi)."),
    ("Drucker-Prager", r"F = \sqrt{J_2} + \alpha I_1 - k", LAWS + "drucker_prager.h",
     "F = sqrt(J2) + alpha I1 - k with alpha, k and the dilatancy matched to plane-strain flow"),
    ("Drucker-Prager matched to Mohr-Coulomb in plane strain",
     r"\beta = \frac{\sin\psi}{\sqrt{9 + 3\sin^2\psi}},\qquad \alpha = \frac{\sin\varphi}{3(\sqrt{1 - 3\beta^2} + \beta\sin\varphi)},\qquad "
     r"k = \frac{c\cos\varphi\,(1 - 3\alpha\beta)}{\sqrt{1 - 3\beta^2}}", LAWS + "yield_cone.h",
     "beta = sin psi / sqrt(9 + 3 sin^2 psi), alpha = sin phi / (3 (sqrt(1 - 3 beta^2) + beta sin phi)), "
     "k = c cos phi (1 - 3 alpha beta) / sqrt(1 - 3 beta^2)."),
    ("Cosserat Mohr-Coulomb", r"F = \sqrt{t^2 + \frac{m\cdot m}{2l^2}} - s\sin\varphi - c\cos\varphi", LAWS + "cosserat_mohr_coulomb.h",
     "F = sqrt(t^2 + m.m/(2 l^2)) - s sin(phi) - c cos(phi) with t and s in the plane."),
    ("Cosserat Drucker-Prager", r"J_2 \to J_2 + \frac{m\cdot m}{2l^2}", LAWS + "cosserat_drucker_prager.h", "J2 + m.m/(2 l^2) in place of J2."),
    ("Return to the cone", r"t(\lambda) = t_0 - G\lambda,\qquad s(\lambda) = s_0 + B\,d(\lambda)\,\lambda,\qquad F(\lambda) = 0", LAWS + "cone_return.h",
     "A radial return has shear_loss = G, pressure_gain_by_dilation = B and nothing else."),
    ("Perzyna's viscosity", r"F = \frac{\eta}{\Delta t}\,\lambda", LAWS + "cone_law.h", "Perzyna: overstress = (viscosity/d_time) lambda."),
    ("hardening = exponential, mobilisation", r"v(\kappa) = v_r + (v_p - v_r)\,e^{-\kappa/\kappa_s},\qquad "
     r"\varphi\ \text{ less }\ (\varphi_p - \varphi_0)\,e^{-\kappa/\kappa_m}", LAWS + "hardening.cc",
     "v(kappa) = v_r + (v_p - v_r) exp(-kappa/kappa_s); friction less (phi_p - phi_0) exp(-kappa/kappa_m) where it is mobilised."),
    ("hardening = critical_state: mobilisation", r"\frac{d\eta}{d\gamma} = \frac{\eta_p(\nu) - \eta}{\gamma_r},\qquad "
     r"\eta_p = \eta_c + A\,\nu_c\ln\frac{\nu}{\nu_c}", LAWS + "hardening.h",
     "d eta / dg = (eta_p(nu) - eta) / g_r, eta_p = eta_c + A nu_c ln(nu / nu_c),"),
    ("hardening = critical_state: dilation", r"\frac{d\varepsilon_v}{d\gamma} = -\sin\psi = -\frac{\eta - \eta_c}{\beta},\qquad d\ln\nu = d\varepsilon_v",
     LAWS + "hardening.h", "d eps_v / dg = -sin psi = -(eta - eta_c) / beta, d ln nu = d eps_v."),
    ("Localisation: acoustic tensor", r"Q_{jk}(n) = n_i C_{ijkl} n_l,\qquad \det Q = 0", LAWS + "localisation.h",
     "Q_jk(n) = n_i C_ijkl n_l; where det Q = 0 a strain increment may jump across a line with the normal n"),
    ("Plastic strain and work", r"d\varepsilon^p = d\varepsilon - C^{-1}(\sigma_1 - \sigma_0),\qquad dD = \sigma_1 : d\varepsilon^p + m\cdot d\kappa^p",
     LAWS + "plastic_flow.h", "d_strain - C^-1 (sigma_1 - sigma_0), out of the plane the strain is zero; and to s1.dissipation the plastic work "
     "sigma_1 : d eps_p + m . d kappa_p"),
    ("Second-order work", r"(\sigma_1 - \sigma_0) : d\varepsilon < 0", LAWS + "plastic_flow.h",
     "Whether the second-order work (sigma_1 - sigma_0) : d eps is negative (Hill, J. Mech. Phys. Solids 6, 1958)"),
]

INTERVALS = [
    ("Batch means", r"\bar b \pm t_{0.975,\,n-1}\; s\,\sqrt{\frac{1 + r}{1 - r}}\Big/\sqrt n", STATISTICS + "batch_means.h",
     "Mean of equally weighted batch means b_k +- t s sqrt((1 + r) / (1 - r)) / sqrt(n)"),
    ("Block bootstrap, few blocks", r"\sqrt{\frac{n}{n - 1}}\;\frac tz", STATISTICS + "block_bootstrap.h",
     "By what deviations of a resampled statistic are stretched: sqrt(n/(n-1)) t/z."),
    ("Block bootstrap, neighbours that agree", r"\operatorname{var} = \sum_b c_{bb} + \sum_{b\ne b'} c_{bb'}", STATISTICS + "block_bootstrap.h",
     "The variance of a sum of blocks is sum c_bb + sum over b != b' c_bb', c = influence_b . influence_b'"),
    ("Equivalence: two one-sided tests", r"[\text{90 % interval of the difference}] \subset (-\text{margin}, +\text{margin})".replace("%", r"\%"),
     "README.md", "*Equivalent* is said where the 90 % interval of the difference continuum - grains, sample by sample, lies within a margin "
     "stated beforehand (two one-sided tests at 5 %)"),
    ("Difference of means as a share (Fieller)", r"\frac{\bar x_2}{\bar x_1} - 1", STATISTICS + "equivalence.h",
     "The difference is (mean of second) / (mean of first) - 1, with Fieller's interval"),
    ("Mean of angles of lines", r"\bar\theta = \tfrac12\arg\sum_k e^{2i\theta_k}", STATISTICS + "equivalence.h",
     "the mean is half the direction of the sum of the unit vectors of the doubled angles"),
    ("Strength over a range", r"\frac TS = \frac{\overline{t}}{\overline{s}}", STATISTICS + "history_table.h",
     "T/S: the mean of t over [from, to] of the progress over that of s"),
]

SEARCHES = [
    ("Weights of a calibration", r"w = \frac{1}{\text{scatter of the mean without its level} + \text{discrepancy}},\qquad \chi^2 = \sum w\,(y - \bar y)^2",
     "coupling/calibration/noise.h",
     "1 / (scatter of the mean without what all bins have in common + discrepancy)"),
    ("Discrepancy of t/s", r"0.008 + 0.03\,e^{-\varepsilon/0.2\,\%}", "coupling/calibration/README.md", "0.008 + 0.03 exp(-strain / 0.2 %) of t/s"),
    ("What the parameters are known to", r"H = J^T W J + \Pi^{-2},\qquad \operatorname{cov} = H^{-1}\left(J^T W C W J + \Pi^{-2}\right)H^{-1}",
     "coupling/calibration/identification.h",
     "With H = J'WJ + 1/prior^2 the estimate has the covariance H^-1 (J'W C W J + 1/prior^2) H^-1:"),
    ("Order of convergence of a study", r"v(h) = v_0 + c\,h^p", "coupling/studies/convergence_order.h", "value = limit + coefficient h^order"),
    ("Error of a size in a plan", r"e(h) = e_{\text{finest}}\left(\frac{h}{h_{\text{finest}}}\right)^{p}", "coupling/plans/error_law.h",
     "error = finest x (size / finest size)^order."),
]
