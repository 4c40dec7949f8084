"""Energies of the laws and their derivatives in 70 digits, and random materials of each law for comparison.

Written from the invariants and stretches of F, as in the documentation of the laws, independently of the program.
Stresses and stiffnesses are differences of the energy, which at this precision are accurate to 30 digits.
"""
from typing import Callable, NamedTuple

from mpmath import mp, mpf

mp.dps = 70
STEP = mpf(10) ** -20  # of differences: truncation error STEP², rounding error 1e-70 / 1e-40


# ---- The formulas. F: nine mpf, row by row. ----

def determinant(F):
    return (F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) +
            F[2] * (F[3] * F[7] - F[4] * F[6]))


def right_cauchy_green(F):
    return [sum(F[3 * k + i] * F[3 * k + j] for k in range(3)) for i in range(3) for j in range(3)]


def product(A, B):
    return [sum(A[3 * i + k] * B[3 * k + j] for k in range(3)) for i in range(3) for j in range(3)]


def trace(A):
    return A[0] + A[4] + A[8]


def invariants(F):
    """I1, I2, J."""
    C = right_cauchy_green(F)
    I1 = trace(C)
    return I1, (I1 * I1 - trace(product(C, C))) / 2, determinant(F)


def isochoric(F):
    """Ī1, Ī2, J, by the cube root of 1/J², which is defined for inverted F too."""
    I1, I2, J = invariants(F)
    p = mp.cbrt(1 / (J * J))
    return p * I1, p * p * I2, J


def squared_stretches(C):
    """Eigenvalues of C by the trigonometric solution of its characteristic equation (O. K. Smith 1961)."""
    mean = trace(C) / 3
    B = [c - (mean if i % 4 == 0 else 0) for i, c in enumerate(C)]
    size = mp.sqrt(trace(product(B, B)) / 6)
    if size < mpf(10) ** -60:
        return [mean] * 3
    cosine = max(-1, min(1, determinant(B) / (2 * size**3)))
    angle = mp.acos(cosine) / 3
    first, last = mean + 2 * size * mp.cos(angle), mean + 2 * size * mp.cos(angle + 2 * mp.pi / 3)
    return [first, 3 * mean - first - last, last]


def quadratic(m, J):
    return m["kappa"] / 2 * (J - 1) ** 2


# ---- The laws. ----

class Law(NamedTuple):
    formula: Callable
    draws: dict  # for each parameter, a function that draws a value typical of soft tissue from a random.Random
    in_range: Callable  # whether F is well within the range of the law with parameters m
    lists: list  # values of parameters that are lists, one dict per material


LAWS = {}


def law(in_range=lambda m, F: True, lists=({}, {}, {}), **draws):
    def register(formula):
        LAWS[formula.__name__] = Law(formula, draws, in_range, lists)
        return formula
    return register


def uniform(low, high):
    return lambda r: r.uniform(low, high)


def materials(name, r):
    """Several materials of a law, in the form of scene files."""
    of = LAWS[name]
    return [{"law": name} | given | {key: draw(r) for key, draw in of.draws.items()} for given in of.lists]


@law(mu=uniform(500, 5e3), **{"lambda": uniform(-300, 2e4)})
def stvk(m, F):
    E = [(c - (1 if i % 4 == 0 else 0)) / 2 for i, c in enumerate(right_cauchy_green(F))]
    return m["lambda"] / 2 * trace(E) ** 2 + m["mu"] * trace(product(E, E))


@law(mu=uniform(500, 5e3), **{"lambda": uniform(-300, 2e4)})
def neo_hookean(m, F):
    I1, _, J = invariants(F)
    return m["mu"] / 2 * (I1 - 3) - m["mu"] * mp.log(J) + m["lambda"] / 2 * mp.log(J) ** 2


@law(K1=uniform(200, 2e3), kappa=uniform(1e3, 1e5))
def neo_hookean_iso(m, F):
    I1, _, J = isochoric(F)
    return m["K1"] * (I1 - 3) + quadratic(m, J)


@law(K1=uniform(200, 2e3), K2=uniform(-100, 500), kappa=uniform(1e3, 1e5))
def mooney_rivlin(m, F):
    I1, I2, J = isochoric(F)
    return m["K1"] * (I1 - 3) + m["K2"] * (I2 - 3) + quadratic(m, J)


@law(lambda m, F: m["gamma"] * (isochoric(F)[0] - 3) < 600,
     mu=uniform(200, 2e3), gamma=uniform(0.05, 3), kappa=uniform(1e3, 1e5))
def fung_demiray(m, F):
    I1, _, J = isochoric(F)
    return m["mu"] / (2 * m["gamma"]) * (mp.exp(m["gamma"] * (I1 - 3)) - 1) + quadratic(m, J)


@law(lists=[{"mu": [-500.0], "alpha": [-4.7]}, {"mu": [300.0, -200.0], "alpha": [3.0, -4.0]},
            {"mu": [630.0, 1.2, -10.0], "alpha": [1.3, 5.0, -2.0]}],
     kappa=uniform(1e3, 1e5))
def ogden(m, F):
    J = determinant(F)
    p = mp.cbrt(1 / (J * J))
    logarithms = [mp.log(p * c) / 2 for c in squared_stretches(right_cauchy_green(F))]
    W = quadratic(m, J)
    for mu, alpha in zip(m["mu"], m["alpha"]):
        W += mu / alpha * (sum(mp.exp(alpha * x) for x in logarithms) - 3)
    return W


def fibre_stretch(m, F):
    """Ī4 of the normalised fibre direction."""
    a = m["fibre"]
    J = determinant(F)
    stretched = [sum(F[3 * i + j] * a[j] for j in range(3)) for i in range(3)]
    return mp.cbrt(1 / (J * J)) * sum(x * x for x in stretched) / sum(x * x for x in a)


@law(lambda m, F: m["k2"] * (fibre_stretch(m, F) - 1) ** 2 < 600,
     K1=uniform(200, 2e3), kappa=uniform(1e3, 1e5), k1=uniform(100, 5e3), k2=uniform(0.05, 1),
     fibre=lambda r: [r.gauss(0, 1) for _ in range(3)])
def hgo(m, F, bears):
    """bears: whether the fibre is in tension, Ī4 > 1; fixed per state, so that differences do not cross the kink."""
    W = neo_hookean_iso(m, F)
    if bears:
        W += m["k1"] / (2 * m["k2"]) * (mp.exp(m["k2"] * (fibre_stretch(m, F) - 1) ** 2) - 1)
    return W


def in_fibre_frame(m, S):
    """Components of a symmetric tensor on orthonormal axes, the first along the fibre."""
    dot = lambda u, v: sum(x * y for x, y in zip(u, v))
    axes = []
    for v in [m["fibre"], *([mpf(k == i) for i in range(3)] for k in range(3))]:
        for u in axes:
            v = [x - dot(u, v) * y for x, y in zip(v, u)]
        if len(axes) < 3 and mp.sqrt(dot(v, v)) > mpf("0.1"):
            axes.append([x / mp.sqrt(dot(v, v)) for x in v])
    return [[sum(u[i] * S[3 * i + j] * v[j] for i in range(3) for j in range(3)) for v in axes] for u in axes]


def guccione_exponent(m, F):
    """Q of the components of Ē."""
    p = mp.cbrt(1 / determinant(F) ** 2)
    E = in_fibre_frame(m, [(p * c - (1 if i % 4 == 0 else 0)) / 2 for i, c in enumerate(right_cauchy_green(F))])
    return (m["bf"] * E[0][0] ** 2 + m["bt"] * (E[1][1] ** 2 + E[2][2] ** 2 + 2 * E[1][2] ** 2) +
            m["bfs"] * (2 * E[0][1] ** 2 + 2 * E[0][2] ** 2))


@law(lambda m, F: guccione_exponent(m, F) < 600,
     C=uniform(200, 2e3), bf=uniform(0.5, 20), bt=uniform(0.5, 8), bfs=uniform(0.5, 8), kappa=uniform(1e3, 1e5),
     fibre=lambda r: [r.choice([-1, 1]) * r.uniform(0.5, 1) for _ in range(3)])
def guccione(m, F):
    return m["C"] / 2 * (mp.exp(guccione_exponent(m, F)) - 1) + quadratic(m, determinant(F))


@law(C10=uniform(200, 2e3), C20=uniform(-50, 50), C30=uniform(0, 20), kappa=uniform(1e3, 1e5))
def yeoh(m, F):
    I1, _, J = isochoric(F)
    return m["C10"] * (I1 - 3) + m["C20"] * (I1 - 3) ** 2 + m["C30"] * (I1 - 3) ** 3 + quadratic(m, J)


@law(lambda m, F: isochoric(F)[0] - 3 < mpf("0.99") * m["Jm"],
     mu=uniform(200, 2e3), Jm=uniform(10, 100), kappa=uniform(1e3, 1e5))
def gent(m, F):
    I1, _, J = isochoric(F)
    return -m["mu"] * m["Jm"] / 2 * mp.log(1 - (I1 - 3) / m["Jm"]) + quadratic(m, J)


@law(mu=uniform(200, 2e3), lambda_m=uniform(1.2, 4), kappa=uniform(1e3, 1e5))
def arruda_boyce(m, F):
    """The integral of the inverse Langevin function, by the first five terms of its series."""
    I1, _, J = isochoric(F)
    links = m["lambda_m"] ** 2
    terms = mpf(3), mpf(9) / 5, mpf(297) / 175, mpf(1539) / 875, mpf(126117) / 67375
    work = lambda I1: sum(c * (I1 / (3 * links)) ** k / (2 * k) for k, c in enumerate(terms, 1))
    return m["mu"] * links * (work(I1) - work(3)) + quadratic(m, J)


@law(lambda m, F: m["beta"] * (isochoric(F)[0] - 3) < 600,
     c1=uniform(20, 300), beta=uniform(0.3, 3), kappa=uniform(1e3, 1e5))
def veronda_westmann(m, F):
    I1, I2, J = isochoric(F)
    return m["c1"] * (mp.exp(m["beta"] * (I1 - 3)) - 1) - m["c1"] * m["beta"] / 2 * (I2 - 3) + quadratic(m, J)


@law(mu=uniform(500, 5e3), **{"lambda": uniform(-300, 2e4)})
def stable_neo_hookean(m, F):
    """Smith, De Goes & Kim 2018, Eq. 14, minus its value at rest."""
    I1, _, J = invariants(F)
    mu, lame = m["mu"] * 4 / 3, m["lambda"] + m["mu"] * 5 / 6
    alpha = 1 + mu / lame - mu / (4 * lame)
    at = lambda I1, J: mu / 2 * (I1 - 3) + lame / 2 * (J - alpha) ** 2 - mu / 2 * mp.log(I1 + 1)
    return at(I1, J) - at(mpf(3), mpf(1))


@law(K1=uniform(200, 2e3), kappa=uniform(1e3, 1e5))
def paper_neo_hookean(m, F):
    I1, _, J = invariants(F)
    return m["K1"] * (I1 - 3) + quadratic(m, J)


@law(K1=uniform(200, 2e3), K2=uniform(-50, 500), kappa=uniform(1e3, 1e5))
def paper_mooney_rivlin(m, F):
    I1, I2, J = invariants(F)
    return m["K1"] * (I1 - 3) + m["K2"] * (I2 - 3) + quadratic(m, J)


@law(lambda m, F: m["gamma"] * (invariants(F)[0] - 3) < 600,
     mu=uniform(200, 2e3), gamma=uniform(0.05, 1), kappa=uniform(1e3, 1e5))
def paper_fung_demiray(m, F):
    I1, _, J = invariants(F)
    return m["mu"] / (2 * m["gamma"]) * (mp.exp(m["gamma"] * (I1 - 3)) - 1) + quadratic(m, J)


VOLUME_TERMS = {  # replace κ/2 (J−1)²
    "logarithmic": lambda kappa, J: kappa / 2 * mp.log(J) ** 2,
    "simo_taylor": lambda kappa, J: kappa / 4 * (J * J - 1 - 2 * mp.log(J)),
}


def numbers(material):
    """The material with its numbers converted to mpf."""
    return {key: value if isinstance(value, str) else [mpf(x) for x in value] if isinstance(value, list) else mpf(value)
            for key, value in material.items()}


def energy_of(material):
    """Functions of F: the energy W in mpf, and whether the fibre is in tension."""
    m = numbers(material)
    formula = LAWS[material["law"]].formula
    term = VOLUME_TERMS.get(material.get("volume_term"))

    def W(F, bears=False):
        value = formula(m, F, bears) if material["law"] == "hgo" else formula(m, F)
        if term:
            J = determinant(F)
            value += term(m["kappa"], J) - quadratic(m, J)
        return value

    def bears(F):
        # If Ī4 is 1 up to rounding (rest, rotations, all stretches equal), the fibre is not in tension.
        return material["law"] == "hgo" and fibre_stretch(m, F) > 1 + mpf(10) ** -14

    return W, bears


def shifted(F, dF, size):
    return [f + size * d for f, d in zip(F, dF)]


def reference(material, F, dF):
    """W, P (9) and dP (9) for F and dF (9 floats each)."""
    W_at, bears = energy_of(material)
    F, dF = [mpf(f) for f in F], [mpf(d) for d in dF]
    side = bears(F)
    W = lambda at: W_at(at, side)
    forward, back = shifted(F, dF, STEP), shifted(F, dF, -STEP)
    P, dP = [], []
    for k in range(9):
        unit = [mpf(k == i) for i in range(9)]
        P.append((W(shifted(F, unit, STEP)) - W(shifted(F, unit, -STEP))) / (2 * STEP))
        dP.append((W(shifted(forward, unit, STEP)) - W(shifted(forward, unit, -STEP)) -
                   W(shifted(back, unit, STEP)) + W(shifted(back, unit, -STEP))) / (4 * STEP**2))
    return W(F), P, dP


def norm(values):
    return mp.sqrt(sum(mpf(v) ** 2 for v in values))
