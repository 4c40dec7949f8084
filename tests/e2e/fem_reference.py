"""Independent reference for static equilibrium: a few hundred linear tetrahedra by Newton's method in numpy.

Stresses come from principal stretches (Ogden 1984), stiffnesses are differences of stresses, forces are assembled from
F = Ds Dm⁻¹ and P: no formula is shared with the program. Slow and simple on purpose.
"""
import numpy as np

# Corners of a cell: bit 0 is x, bit 1 y, bit 2 z.
EVEN_CELL = [(0, 1, 2, 4), (3, 2, 1, 7), (5, 1, 4, 7), (6, 4, 2, 7), (1, 2, 4, 7)]
ODD_CELL = [(1, 0, 3, 5), (2, 0, 3, 6), (4, 0, 5, 6), (7, 3, 5, 6), (0, 3, 5, 6)]


def irregular_box(size, cells, jitter, seed):
    """Nodes (#V×3, m) and tetrahedra (#T×4) of a block of cells, 5 tetrahedra each, mirrored between neighbours. Nodes
    not at the two ends in x are moved by up to `jitter` of a cell. Coordinates are rounded to 12 digits, so that text
    files keep them exactly."""
    nx, ny, nz = cells
    number = lambda i, j, k: i + (nx + 1) * (j + (ny + 1) * k)
    grid = np.array([[i, j, k] for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)], float)
    moves = np.random.RandomState(seed).uniform(-jitter, jitter, grid.shape)
    moves[(grid[:, 0] == 0) | (grid[:, 0] == nx)] = 0
    nodes = np.vectorize(lambda x: float(f"{x:.12g}"))((grid + moves) * np.array(size) / np.array(cells))
    tets = []
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                corner = [number(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)) for c in range(8)]
                tets += [[corner[c] for c in tet] for tet in (ODD_CELL if (i + j + k) % 2 else EVEN_CELL)]
    tets = np.array(tets)
    flipped = volumes(nodes, tets) < 0
    tets[flipped, :2] = tets[flipped, 1::-1]
    return nodes, tets


def volumes(nodes, tets):
    """Signed volumes, m³ (#T)."""
    a, b, c, d = (nodes[tets[:, k]] for k in range(4))
    return np.einsum("ti,ti->t", b - a, np.cross(c - a, d - a)) / 6


# J ψ'(J) of the volume terms, for κ = 1.
VOLUME_STRESS = {
    "quadratic": lambda J: J * (J - 1),
    "logarithmic": np.log,
    "simo_taylor": lambda J: (J * J - 1) / 2,
}


def isochoric(stretches, w1, w2):
    """Principal Kirchhoff stress (#T×3) of w(Ī1, Ī2) from stretches (#T×3), w1 a function of Ī1."""
    J = stretches.prod(axis=1, keepdims=True)
    bar = (stretches / np.cbrt(J)) ** 2
    I1, I2 = bar.sum(axis=1, keepdims=True), (1 / bar).sum(axis=1, keepdims=True)
    return 2 * w1(I1) * (bar - I1 / 3) - 2 * w2 * (1 / bar - I2 / 3)


def ogden(stretches, mu, alpha):
    bar = stretches / np.cbrt(stretches.prod(axis=1, keepdims=True))
    return sum(m * (bar**a - (bar**a).mean(axis=1, keepdims=True)) for m, a in zip(mu, alpha))


def stvk(stretches, lam, mu):
    E = (stretches**2 - 1) / 2
    return stretches**2 * (lam * E.sum(axis=1, keepdims=True) + 2 * mu * E)


def principal_stress(material, stretches):
    """Principal Kirchhoff stress (#T×3, Pa) of a material of a scene file, without its fibres."""
    m = material
    J = stretches.prod(axis=1, keepdims=True)
    match m["law"]:
        case "stvk":
            return stvk(stretches, m["lambda"], m["mu"])
        case "neo_hookean":
            return m["mu"] * (stretches**2 - 1) + m["lambda"] * np.log(J)
        case "neo_hookean_iso" | "hgo":
            stress = isochoric(stretches, lambda I1: m["K1"], 0)
        case "mooney_rivlin":
            stress = isochoric(stretches, lambda I1: m["K1"], m["K2"])
        case "fung_demiray":
            stress = isochoric(stretches, lambda I1: m["mu"] / 2 * np.exp(m["gamma"] * (I1 - 3)), 0)
        case "ogden":
            stress = ogden(stretches, m["mu"], m["alpha"])
    return stress + m["kappa"] * VOLUME_STRESS[m.get("volume_term", "quadratic")](J)


def fibre_stress(material, F):
    """P (#T×3×3) of the fibres of hgo: w4 ∂Ī4/∂F with w4 = k1 (Ī4−1) exp(k2 (Ī4−1)²) in tension, else 0."""
    a = np.array(material["fibre"]) / np.linalg.norm(material["fibre"])
    Fa, p = F @ a, np.cbrt(np.linalg.det(F)) ** -2
    I4 = p * (Fa * Fa).sum(axis=1)
    e = np.maximum(I4 - 1, 0)
    slope = (2 * p)[:, None, None] * Fa[:, :, None] * a - (2 / 3 * I4)[:, None, None] * np.linalg.inv(F).swapaxes(1, 2)
    return (material["k1"] * e * np.exp(material["k2"] * e**2))[:, None, None] * slope


def first_piola(material, F):
    """P (#T×3×3) = F Σ τi/λi² Ni Niᵀ with the eigenvectors Ni of C, plus the fibres' part."""
    squares, N = np.linalg.eigh(np.einsum("tki,tkj->tij", F, F))
    P = F @ np.einsum("ti,tai,tbi->tab", principal_stress(material, np.sqrt(squares)) / squares, N, N)
    return P + fibre_stress(material, F) if material["law"] == "hgo" else P


class Body:
    """Linear tetrahedra of one material."""

    def __init__(self, nodes, tets, material):
        self.nodes, self.tets, self.material = nodes, tets, material
        edges = np.stack([nodes[tets[:, k]] - nodes[tets[:, 0]] for k in (1, 2, 3)], axis=2)
        inverse = np.linalg.inv(edges)  # rows: gradients of the shape functions of corners 1 to 3
        self.gradients = np.concatenate([-inverse.sum(axis=1, keepdims=True), inverse], axis=1)  # #T×4×3
        self.volumes = volumes(nodes, tets)

    def deformation(self, x):
        return np.einsum("tak,tal->tkl", x[self.tets], self.gradients)

    def gradient(self, x):
        """Gradient of the energy by the positions x (#V×3): minus the forces, N."""
        P = first_piola(self.material, self.deformation(x))
        g = np.zeros_like(x)
        np.add.at(g, self.tets, np.einsum("t,tkl,tal->tak", self.volumes, P, self.gradients))
        return g

    def stiffness(self, x):
        """Dense stiffness, 3#V×3#V, by central differences of P."""
        F, h = self.deformation(x), 1e-6
        K = np.zeros((x.size, x.size))
        for k in range(3):
            for l in range(3):
                step = np.zeros((3, 3))
                step[k, l] = h
                dP = (first_piola(self.material, F + step) - first_piola(self.material, F - step)) / (2 * h)
                block = np.einsum("t,tij,taj,tb->taib", self.volumes, dP, self.gradients, self.gradients[:, :, l])
                rows = 3 * self.tets[:, :, None, None] + np.arange(3)[None, None, :, None]
                np.add.at(K, (rows, (3 * self.tets + k)[:, None, None, :]), block)
        return K


def equilibrium(body, held, target, increments=4):
    """Positions (#V×3) with no force on nodes outside `held`; constrained nodes (`held`) move to `target` linearly.
    Raises RuntimeError if Newton's method does not converge."""
    x = body.nodes.copy()
    free = np.setdiff1d(np.arange(x.size), (3 * held[:, None] + np.arange(3)).ravel())
    for k in range(1, increments + 1):
        before = x.copy()
        x[held] = body.nodes[held] + (target - body.nodes[held]) * k / increments
        # First guess: the linearised motion of the free nodes.
        K = body.stiffness(before)
        x.ravel()[free] -= np.linalg.solve(K[np.ix_(free, free)], K[free] @ (x - before).ravel())
        for _ in range(30):
            g = body.gradient(x)
            residual = np.linalg.norm(g.ravel()[free]) / np.linalg.norm(g[held])
            if residual < 1e-12:
                break
            step = np.linalg.solve(body.stiffness(x)[np.ix_(free, free)], g.ravel()[free])
            x.ravel()[free] -= step
        else:
            raise RuntimeError(f"no equilibrium: residual {residual:.1e} at {k}/{increments}")
    return x
