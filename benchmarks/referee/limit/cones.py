# diptych: stress of the largest load as a second-order cone program, by cvxopt with a sparse factorisation
# SPDX-License-Identifier: LGPL-2.1-or-later
import cvxopt
import cvxopt.cholmod
import cvxopt.solvers
import numpy
import scipy.sparse

OPTIONS = {"show_progress": False, "abstol": 1e-30, "reltol": 1e-6, "feastol": 1e-6, "maxiters": 100, "refinement": 2}
SHIFTS = (0, 1e-15, 1e-14, 1e-13, 1e-12)


def to_cvxopt(matrix):
    entries = matrix.tocoo()
    return cvxopt.spmatrix(entries.data, entries.row, entries.col, entries.shape)


def factorised(matrix):
    """Cholesky factor of a sparse matrix. A share of the diagonal is added only where rounding makes the matrix
    indefinite; cvxopt's iterative refinement removes its effect. Throws ArithmeticError, on which cvxopt stops."""
    for shift in SHIFTS:
        lower = to_cvxopt(scipy.sparse.tril(matrix + scipy.sparse.diags(shift * matrix.diagonal())))
        factor = cvxopt.cholmod.symbolic(lower)
        try:
            cvxopt.cholmod.numeric(lower, factor)
        except ArithmeticError:
            continue
        return factor
    raise ArithmeticError


def sparse_solver(G):
    """Solver of cvxopt's systems [[0, G'], [G, -W'W]] for cones of three entries: G' (W'W)^-1 G is sparse, because W
    has blocks of 3 x 3. W = beta (2 v v' - J) with J = diag(1, -1, -1), so its inverse is (2 J v v' J - J) / beta."""
    mirror = numpy.diag((1.0, -1.0, -1.0))

    def factor(scaling):
        v = numpy.array([numpy.array(one).ravel() for one in scaling["v"]]) @ mirror
        inverse = (2 * v[:, :, None] * v[:, None, :] - mirror) / numpy.array(scaling["beta"])[:, None, None]
        n = 3 * len(v)
        blocks = scipy.sparse.bsr_matrix((inverse, numpy.arange(len(v)), numpy.arange(len(v) + 1)),
                                         shape=(n, n)).tocsr()
        scaled = blocks @ G
        factor = factorised((scaled.T @ scaled).tocsc())

        def solve(x, _, z):
            scaled_z = blocks @ numpy.array(z).ravel()
            x += cvxopt.matrix(scaled.T @ scaled_z)
            cvxopt.cholmod.solve(factor, x)
            z[:] = cvxopt.matrix(scaled @ numpy.array(x).ravel() - scaled_z)
        return solve
    return factor


def largest(objective, A, b, soil, margin=0.0, *, n_contacts=0):
    """Stress (9 m,) with the largest objective.stress subject to A stress = b and Mohr-Coulomb's condition for each
    three components, the multipliers of the equations, and the number of iterations.

    In terms of z = ((2 c cot(phi) - s_xx - s_yy) sin(phi), s_xx - s_yy, 2 s_xy) the condition is z_0 >= |(z_1, z_2)|, a
    cone. The stresses are the variables of cvxopt's dual problem, so its primal variables are the multipliers. The cone
    that holds the strain rates of the multipliers is narrowed by `margin`, which adds at most margin x sum of z_0 to
    the result. The last n_contacts triples are no stresses, but the cones (mu N, T, 0) of contacts themselves."""
    n = A.shape[1] // 3
    volume, n_soil = -0.5 / soil.sine, n - n_contacts
    of_soil = scipy.sparse.kron(scipy.sparse.identity(n_soil), [[volume, 0.5, 0], [volume, -0.5, 0], [0, 0, 0.5]])
    back = scipy.sparse.block_diag((of_soil, scipy.sparse.identity(3 * n_contacts))).tocsr()
    apex = numpy.concatenate((numpy.tile((soil.apex, soil.apex, 0.0), n_soil), numpy.zeros(3 * n_contacts)))
    G = (A @ back).T.tocsr()
    strain = -(back.T @ objective)
    strain[0:3 * n_soil:3] -= margin  # stress = apex + back z
    found = cvxopt.solvers.conelp(cvxopt.matrix(A @ apex - b), to_cvxopt(G), cvxopt.matrix(strain),
                                  {"l": 0, "q": [3] * n, "s": []}, kktsolver=sparse_solver(G), options=OPTIONS)
    return apex + back @ numpy.array(found["z"]).ravel(), numpy.array(found["x"]).ravel(), found["iterations"]
