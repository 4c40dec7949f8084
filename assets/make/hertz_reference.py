"""Force of a rigid ball that is pressed into a cylinder without friction: the reference of `heml study validation`.

The cylinder (neo-Hookean, W = mu/2 (I1bar - 3) + kappa/2 (J - 1)^2) stands on a base that holds it. Axisymmetric
quadrilaterals of nine nodes, smaller towards the ball; contact is a stiff penalty at eight points an element of the
top; Newton's method. Needs NumPy and SciPy: python3 assets/make/hertz_reference.py [CELLS ...]
"""
import sys

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import spsolve

BALL, RADIUS, HEIGHT = 0.02, 0.04, 0.04  # m
SHEAR, POISSON = 3e3, 0.3  # Pa
BULK = 2 * SHEAR * (1 + POISSON) / (3 * (1 - 2 * POISSON))
DEPTHS = 0.0005, 0.001, 0.002, 0.004  # m
PENALTIES = 9e8 * np.array([1, 5, 25])  # Pa/m, one after the other
GRADING = 2


def shape(x):
    return np.array([x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2])


def slope(x):
    return np.array([x - 0.5, -2 * x, x + 0.5])


def stress(F):
    """First Piola-Kirchhoff stress at F = rr, rz, zr, zz, angle (5 x points), complex allowed."""
    rr, rz, zr, zz, angle = F
    plane = rr * zz - rz * zr
    J = plane * angle
    inverse = zz / plane, -zr / plane, -rz / plane, rr / plane, 1 / angle  # transposed
    I1 = sum(f * f for f in F)
    return np.array([SHEAR * J**(-2 / 3) * (f - I1 / 3 * i) + BULK * (J - 1) * J * i for f, i in zip(F, inverse)])


class Cylinder:
    def __init__(self, cells):
        corners = np.linspace(0, 1, cells + 1)**GRADING
        line = np.zeros(2 * cells + 1)
        line[::2], line[1::2] = corners, (corners[1:] + corners[:-1]) / 2
        side = len(line)
        self.X = np.array([[RADIUS * r, -HEIGHT * z] for z in line[::-1] for r in line])
        self.elements = np.array([[(2 * j + b) * side + 2 * i + a for b in range(3) for a in range(3)]
                                  for j in range(cells) for i in range(cells)])
        held = np.zeros((len(self.X), 2), bool)
        held[:side] = True  # the base
        held[::side, 0] = True  # the axis
        self.free = np.flatnonzero(~held)
        self.integrate(*np.polynomial.legendre.leggauss(3))
        self.face_the_ball(side, cells, *np.polynomial.legendre.leggauss(8))
        self.u = np.zeros(2 * len(self.X))

    def integrate(self, points, weights):
        nodes, B, W = [], [], []
        for z, wz in zip(points, weights):
            for r, wr in zip(points, weights):
                N = np.outer(shape(z), shape(r)).ravel()
                d = np.array([np.outer(shape(z), slope(r)).ravel(), np.outer(slope(z), shape(r)).ravel()])
                place = self.X[self.elements]
                jacobian = np.einsum("ka,eai->eki", d, place)
                gradient = np.linalg.inv(jacobian) @ d
                R = place[:, :, 0] @ N
                b = np.zeros((len(R), 5, 18))
                b[:, 0, 0::2] = b[:, 2, 1::2] = gradient[:, 0]
                b[:, 1, 0::2] = b[:, 3, 1::2] = gradient[:, 1]
                b[:, 4, 0::2] = N / R[:, None]
                nodes.append(self.elements)
                B.append(b)
                W.append(wr * wz * np.linalg.det(jacobian) * 2 * np.pi * R)
        nodes = np.concatenate(nodes)
        self.B, self.W = np.concatenate(B), np.concatenate(W)
        self.place = np.stack([2 * nodes, 2 * nodes + 1], 2).reshape(len(nodes), 18)

    def face_the_ball(self, side, cells, points, weights):
        top = len(self.X) - side
        faces = np.array([[top + 2 * i + a for a in range(3)] for i in range(cells)])
        R = self.X[:, 0][faces]
        self.faces = np.repeat(faces, len(points), axis=0)
        self.N = np.tile([shape(x) for x in points], (cells, 1))
        length = np.concatenate([[row @ slope(x) for x in points] for row in R])
        self.area = np.tile(weights, cells) * length * 2 * np.pi * np.einsum("pa,pa->p", self.N, self.X[self.faces, 0])

    def tissue(self):
        F = np.einsum("pcd,pd->cp", self.B, self.u[self.place]) + np.array([[1], [0], [0], [1], [1]])
        D = np.empty((5, 5, len(self.W)))
        for k in range(5):
            moved = F.astype(complex)
            moved[k] += 1e-30j
            D[:, k] = stress(moved).imag / 1e-30
        f = np.zeros(len(self.u))
        np.add.at(f, self.place, np.einsum("pcd,cp,p->pd", self.B, stress(F), self.W, optimize=True))
        K = np.einsum("pcd,ckp,pke,p->pde", self.B, D, self.B, self.W, optimize=True)
        return f, self.assembled(K, self.place)

    def ball(self, depth, penalty):
        moved = self.X + self.u.reshape(-1, 2)
        across = np.einsum("pa,pai->pi", self.N, moved[self.faces]) - [0, BALL - depth]
        distance = np.linalg.norm(across, axis=1)
        gap = distance - BALL
        f, touching = np.zeros(len(self.u)), gap < 0
        faces, N, normal = self.faces[touching], self.N[touching], (across / distance[:, None])[touching]
        area, gap, distance = self.area[touching], gap[touching], distance[touching]
        place = np.stack([2 * faces, 2 * faces + 1], 2).reshape(-1, 6)
        push = np.einsum("p,pa,pi->pai", penalty * gap * area, N, normal)
        np.add.at(f, place, push.reshape(-1, 6))
        outer = np.einsum("pi,pj->pij", normal, normal)
        bend = np.maximum(gap, -1e-5) / distance  # of the normal; deep gaps are of the first iterations alone
        block = outer + bend[:, None, None] * (np.eye(2) - outer)
        K = np.einsum("p,pa,pb,pij->paibj", penalty * area, N, N, block).reshape(-1, 6, 6)
        return f, self.assembled(K, place), push[:, :, 1].sum()

    def assembled(self, K, place):
        width = place.shape[1]
        rows, columns = np.repeat(place, width, axis=1).ravel(), np.tile(place, (1, width)).ravel()
        return sparse.csr_matrix((K.ravel(), (rows, columns)), 2 * (len(self.u),))

    def press(self, depth):
        for penalty in PENALTIES:
            force = self.balance(depth, penalty)
        return force

    def balance(self, depth, penalty):
        for iteration in range(100):
            f, K = self.tissue()
            of_ball, K_ball, force = self.ball(depth, penalty)
            r = -(f + of_ball)[self.free]
            if iteration > 0 and np.linalg.norm(r) < 1e-9 * abs(force):
                return force
            du = spsolve((K + K_ball)[self.free][:, self.free].tocsc(), r)
            self.u[self.free] += min(1, 0.3 * depth / np.abs(du).max()) * du
        raise RuntimeError(f"did not converge at {depth} m")


for number in [int(word) for word in sys.argv[1:]] or [40, 80]:
    cylinder = Cylinder(number)
    for depth in DEPTHS:
        print(f"{number} cells, depth {depth} m: {cylinder.press(depth):.7f} N", flush=True)
