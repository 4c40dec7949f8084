#pragma once
// The element loops, included by the files that compile them: naive_native.cpp and naive_portable.cpp. They use no
// inline functions of other headers: the linker might keep the copy compiled here for the whole program.
#include <cmath>
#include <studies/naive_loops.hpp>

namespace heml {
namespace {

struct Matrix {
  double m[3][3];
};

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j];
  return c;
}

Matrix transposed(const Matrix& a) {
  Matrix c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c.m[i][j] = a.m[j][i];
  return c;
}

/// ∂(det a)/∂a.
Matrix cofactor(const Matrix& a) {
  Matrix c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int p = (i + 1) % 3, q = (i + 2) % 3, r = (j + 1) % 3, s = (j + 2) % 3;
      c.m[i][j] = a.m[p][r] * a.m[q][s] - a.m[p][s] * a.m[q][r];
    }
  return c;
}

double determinant(const Matrix& a) {
  const Matrix c = cofactor(a);
  return a.m[0][0] * c.m[0][0] + a.m[0][1] * c.m[0][1] + a.m[0][2] * c.m[0][2];
}

double trace(const Matrix& a) { return a.m[0][0] + a.m[1][1] + a.m[2][2]; }

/// u I + v A.
Matrix sum(double u, double v, const Matrix& A) {
  Matrix c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c.m[i][j] = v * A.m[i][j] + (i == j ? u : 0);
  return c;
}

/// u I + v A + w B.
Matrix sum(double u, double v, const Matrix& A, double w, const Matrix& B) {
  Matrix c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c.m[i][j] = v * A.m[i][j] + w * B.m[i][j] + (i == j ? u : 0);
  return c;
}

/// Strain measures that laws read. Inlined, so that a loop computes only what its law uses.
struct Strain {
  Matrix C, C_inverse;
  double J, I1, I2;
};

[[gnu::always_inline]] inline Strain strain_measures(const Matrix& F) {
  Strain at;
  at.C = product(transposed(F), F);
  at.J = determinant(F);
  at.I1 = trace(at.C);
  at.I2 = (at.I1 * at.I1 - trace(product(at.C, at.C))) / 2;
  at.C_inverse = cofactor(at.C);
  const double by = 1 / (at.J * at.J);
  for (auto& row : at.C_inverse.m)
    for (double& entry : row) entry *= by;
  return at;
}

/// S of w(Ī1) + κ/2 (J−1)², from w1 = ∂w/∂Ī1.
Matrix isochoric_stress(const Strain& at, double w1, double kappa) {
  const double p = 1 / std::cbrt(at.J * at.J);
  return sum(2 * w1 * p, kappa * (at.J - 1) * at.J - 2 * w1 * p * at.I1 / 3, at.C_inverse);
}

/// S of w(Ī1, Ī2) + κ/2 (J−1)², from the first derivatives of w.
Matrix isochoric_stress(const Strain& at, double w1, double w2, double kappa) {
  const double p = 1 / std::cbrt(at.J * at.J), q = p * p;
  const double pressure = kappa * (at.J - 1) * at.J;
  return sum(2 * w1 * p + 2 * w2 * q * at.I1, -2 * w2 * q, at.C,
             pressure - 2 * w1 * p * at.I1 / 3 - 4 * w2 * q * at.I2 / 3, at.C_inverse);
}

/// Ī1 − 3.
double isochoric_excess(const Strain& at) { return at.I1 / std::cbrt(at.J * at.J) - 3; }

/// Eigenvalues and eigenvectors (columns of V) of C by Jacobi rotations.
void eigen(Matrix C, double value[3], Matrix& V) {
  V = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int sweep = 0; sweep < 20; ++sweep) {
    const double off = C.m[0][1] * C.m[0][1] + C.m[0][2] * C.m[0][2] + C.m[1][2] * C.m[1][2];
    if (off < 1e-34 * trace(C) * trace(C)) break;
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        if (C.m[p][q] == 0) continue;
        const double theta = (C.m[q][q] - C.m[p][p]) / (2 * C.m[p][q]);
        const double t = (theta < 0 ? -1 : 1) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        Matrix R = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        R.m[p][p] = R.m[q][q] = c, R.m[p][q] = s, R.m[q][p] = -s;
        C = product(transposed(R), product(C, R));
        V = product(V, R);
      }
  }
  for (int i = 0; i < 3; ++i) value[i] = C.m[i][i];
}

// Second Piola–Kirchhoff stresses S = 2 ∂W/∂C, Pa.

struct StVK {
  static Matrix stress(const Strain& at, const NaiveBody& body) {
    const double lambda = body.parameter[0], mu = body.parameter[1];
    return sum(lambda / 2 * (at.I1 - 3) - mu, mu, at.C);
  }
};

struct NeoHookean {
  static Matrix stress(const Strain& at, const NaiveBody& body) {
    const double lambda = body.parameter[0], mu = body.parameter[1];
    return sum(mu, lambda * std::log(at.J) - mu, at.C_inverse);
  }
};

struct NeoHookeanIso {
  static Matrix stress(const Strain& at, const NaiveBody& body) {
    return isochoric_stress(at, body.parameter[0], body.parameter[1]);
  }
};

struct MooneyRivlin {
  static Matrix stress(const Strain& at, const NaiveBody& body) {
    return isochoric_stress(at, body.parameter[0], body.parameter[1], body.parameter[2]);
  }
};

struct FungDemiray {
  static Matrix stress(const Strain& at, const NaiveBody& body) {
    const double mu = body.parameter[0], gamma = body.parameter[1];
    return isochoric_stress(at, mu / 2 * std::exp(gamma * isochoric_excess(at)), body.parameter[2]);
  }
};

struct Ogden {
  static Matrix stress(const Strain& at, const NaiveBody& body) {
    const std::size_t terms = (body.parameters - 1) / 2;
    const double kappa = body.parameter[2 * terms];
    double c[3], tau[3];
    Matrix N;
    eigen(at.C, c, N);
    for (double& t : tau) t = kappa * (at.J - 1) * at.J;
    const double shrink = 1 / std::cbrt(at.J);
    for (std::size_t k = 0; k < terms; ++k) {
      double power[3];
      for (int i = 0; i < 3; ++i) power[i] = std::pow(shrink * std::sqrt(c[i]), body.parameter[terms + k]);
      const double mean = (power[0] + power[1] + power[2]) / 3;
      for (int i = 0; i < 3; ++i) tau[i] += body.parameter[k] * (power[i] - mean);
    }
    Matrix S{};
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) S.m[i][j] += tau[k] / c[k] * N.m[i][k] * N.m[j][k];
    return S;
  }
};

struct Hgo {
  static Matrix stress(const Strain& at, const NaiveBody& body) {
    const double k1 = body.parameter[2], k2 = body.parameter[3];
    const double* a = body.fibre;
    Matrix S = isochoric_stress(at, body.parameter[0], body.parameter[1]);
    double I4 = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) I4 += a[i] * at.C.m[i][j] * a[j];
    const double p = 1 / std::cbrt(at.J * at.J), stretch = p * I4 - 1;
    if (!(stretch > 0)) return S;
    const double w4 = 2 * p * k1 * stretch * std::exp(k2 * stretch * stretch);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) S.m[i][j] += w4 * (a[i] * a[j] - I4 / 3 * at.C_inverse.m[i][j]);
    return S;
  }
};

/// ∂Q/∂Ē = 2 bt Ē + 2 (bf + bt − 2 bfs) (a·Ēa) a aᵀ + 2 (bfs − bt) (a (Ēa)ᵀ + Ēa aᵀ) of the strain Ē itself.
struct Guccione {
  static Matrix stress(const Strain& at, const NaiveBody& body) {
    const double bf = body.parameter[1], bt = body.parameter[2], bfs = body.parameter[3];
    const double* a = body.fibre;
    const double p = 1 / std::cbrt(at.J * at.J);
    Matrix E, Q1;
    double Ea[3], along = 0, squares = 0, shear = 0, volumetric = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) E.m[i][j] = (p * at.C.m[i][j] - (i == j ? 1 : 0)) / 2;
    for (int i = 0; i < 3; ++i) {
      Ea[i] = E.m[i][0] * a[0] + E.m[i][1] * a[1] + E.m[i][2] * a[2];
      along += a[i] * Ea[i], shear += Ea[i] * Ea[i];
      for (int j = 0; j < 3; ++j) squares += E.m[i][j] * E.m[i][j];
    }
    const double Q = bt * squares + (bf + bt - 2 * bfs) * along * along + 2 * (bfs - bt) * shear;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        Q1.m[i][j] = 2 * bt * E.m[i][j] + 2 * (bf + bt - 2 * bfs) * along * a[i] * a[j] +
                     2 * (bfs - bt) * (a[i] * Ea[j] + Ea[i] * a[j]);
        volumetric += Q1.m[i][j] * at.C.m[i][j];
      }
    const double scale = body.parameter[0] / 2 * std::exp(Q) * p;
    const double pressure = body.parameter[4] * (at.J - 1) * at.J - scale * volumetric / 3;
    Matrix S{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) S.m[i][j] = scale * Q1.m[i][j] + pressure * at.C_inverse.m[i][j];
    return S;
  }
};

struct Yeoh {
  static Matrix stress(const Strain& at, const NaiveBody& body) {
    const double e = isochoric_excess(at);
    const double w1 = body.parameter[0] + e * (2 * body.parameter[1] + 3 * e * body.parameter[2]);
    return isochoric_stress(at, w1, body.parameter[3]);
  }
};

struct Gent {
  static Matrix stress(const Strain& at, const NaiveBody& body) {
    const double mu = body.parameter[0], Jm = body.parameter[1];
    return isochoric_stress(at, mu / 2 / (1 - isochoric_excess(at) / Jm), body.parameter[2]);
  }
};

struct VerondaWestmann {
  static Matrix stress(const Strain& at, const NaiveBody& body) {
    const double c1 = body.parameter[0], beta = body.parameter[1];
    return isochoric_stress(at, c1 * beta * std::exp(beta * isochoric_excess(at)), -c1 * beta / 2, body.parameter[2]);
  }
};

struct StableNeoHookean {
  static Matrix stress(const Strain& at, const NaiveBody& body) {
    const double lambda = body.parameter[0], mu = body.parameter[1];
    const double wJ = (lambda + 5 * mu / 6) * (at.J - 1) - mu;
    return sum(4 * mu / 3 * at.I1 / (at.I1 + 1), wJ * at.J, at.C_inverse);
  }
};

/// S of w(I1) + κ/2 (J−1)².
Matrix printed_stress(const Strain& at, double w1, double kappa) {
  return sum(2 * w1, kappa * (at.J - 1) * at.J, at.C_inverse);
}

/// S of w(I1, I2) + κ/2 (J−1)².
Matrix printed_stress(const Strain& at, double w1, double w2, double kappa) {
  return sum(2 * w1 + 2 * w2 * at.I1, -2 * w2, at.C, kappa * (at.J - 1) * at.J, at.C_inverse);
}

struct PaperNeoHookean {
  static Matrix stress(const Strain& at, const NaiveBody& body) {
    return printed_stress(at, body.parameter[0], body.parameter[1]);
  }
};

struct PaperMooneyRivlin {
  static Matrix stress(const Strain& at, const NaiveBody& body) {
    return printed_stress(at, body.parameter[0], body.parameter[1], body.parameter[2]);
  }
};

struct PaperFungDemiray {
  static Matrix stress(const Strain& at, const NaiveBody& body) {
    const double mu = body.parameter[0], gamma = body.parameter[1];
    return printed_stress(at, mu / 2 * std::exp(gamma * (at.I1 - 3)), body.parameter[2]);
  }
};

template <class Law>
void element_loop(const NaiveBody& body, const double* x, double* f) {
  for (std::size_t i = 0; i < 3 * body.nodes; ++i) f[i] = 0;
  for (std::size_t t = 0; t < body.tets; ++t) {
    const int* corner = body.corners + 4 * t;
    Matrix Ds, Dm_inverse;
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < 3; ++a) {
        Ds.m[i][a] = x[3 * corner[a + 1] + i] - x[3 * corner[0] + i];
        Dm_inverse.m[i][a] = body.Dm_inverse[9 * t + static_cast<std::size_t>(3 * i + a)];
      }
    const Matrix F = product(Ds, Dm_inverse);
    const Matrix P = product(F, Law::stress(strain_measures(F), body));
    const Matrix H = product(P, transposed(Dm_inverse));
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < 3; ++a) {
        const double force = -body.volume[t] * H.m[i][a];
        f[3 * corner[a + 1] + i] += force;
        f[3 * corner[0] + i] -= force;
      }
  }
}

void spring_loop(const NaiveBody& body, const double* x, double* f) {
  for (std::size_t i = 0; i < 3 * body.nodes; ++i) f[i] = 0;
  for (std::size_t s = 0; s < body.springs; ++s) {
    const int a = 3 * body.ends[2 * s], b = 3 * body.ends[2 * s + 1];
    const double d[3] = {x[b] - x[a], x[b + 1] - x[a + 1], x[b + 2] - x[a + 2]};
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if (length == 0) continue;
    const double tension = body.parameter[0] * (length - body.rest_length[s]) / length;
    for (int i = 0; i < 3; ++i) {
      f[a + i] += tension * d[i];
      f[b + i] -= tension * d[i];
    }
  }
}

constexpr NaiveSet::Entry loops[] = {{"stvk", element_loop<StVK>},
                                     {"neo_hookean", element_loop<NeoHookean>},
                                     {"neo_hookean_iso", element_loop<NeoHookeanIso>},
                                     {"mooney_rivlin", element_loop<MooneyRivlin>},
                                     {"fung_demiray", element_loop<FungDemiray>},
                                     {"ogden", element_loop<Ogden>},
                                     {"hgo", element_loop<Hgo>},
                                     {"guccione", element_loop<Guccione>},
                                     {"yeoh", element_loop<Yeoh>},
                                     {"gent", element_loop<Gent>},
                                     {"veronda_westmann", element_loop<VerondaWestmann>},
                                     {"stable_neo_hookean", element_loop<StableNeoHookean>},
                                     {"paper_neo_hookean", element_loop<PaperNeoHookean>},
                                     {"paper_mooney_rivlin", element_loop<PaperMooneyRivlin>},
                                     {"paper_fung_demiray", element_loop<PaperFungDemiray>},
                                     {"mass_spring", spring_loop}};

#define HEML_COMPILED_FOR(macro, name) , HEML_IS_ONE(macro)
constexpr bool compiled_for[] = {true HEML_X86_FEATURES(HEML_COMPILED_FOR)};
#undef HEML_COMPILED_FOR

constexpr NaiveSet this_set = {HEML_NAIVE_FLAGS, loops, std::size(loops), compiled_for, std::size(compiled_for)};

}  // namespace
}  // namespace heml
