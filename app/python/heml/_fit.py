"""Fits parameters of a scene to measured places of its nodes in a static equilibrium."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

import heml
from heml._equilibrium import Equilibrium, rest_world, unsupported, with_selected_nodes
from heml._optional import require
from heml._scene_paths import get_number, name_moduli, set_number

Array = NDArray[np.float64]
Bounds = tuple[float, float, float]

_step = 1e-3  # of differences between equilibria, relative to the parameter
_fine = 0.1  # step of differences of the residual, relative to that: they are of fourth order and without a solver
_little = 1e-6  # fall of the misfit that is none, relative to it
_short = 1e-4  # step that is none: of logarithms of parameters
_far = 20.0  # change of the logarithm of a parameter that no measurement asks for: a factor of 5e8
_reach = 25.0  # largest one
_not_least = "the search ended where a step would still lower the misfit: begin nearer to the solution, or give bounds"
_agreement = 1e-5  # residual of the engine's equilibrium, relative to the external forces


@dataclass(frozen=True)
class FitResult:
    """Fitted parameters with their uncertainty. P parameters, m observed nodes, V nodes."""

    values: dict[str, float]
    """Fitted value by path."""
    standard_errors: dict[str, float]
    """Standard error by path; inf where the observations do not determine the parameters."""
    confidence: dict[str, tuple[float, float]]
    """95 % confidence interval by path, linearised at the solution."""
    covariance: Array
    """(P, P), in the order of `values`."""
    jacobian: Array
    """(m, 3, P): change of observed places by parameters."""
    gradient: Array
    """(P,): of half the sum of squared residuals in units of sigma (of 1 m where no sigma is given)."""
    residuals: Array
    """(m, 3) m: computed minus measured places."""
    rms: float
    """Root mean square of the residuals' components, m."""
    positions: Array
    """(V, 3) m: the equilibrium with the fitted parameters."""
    scene: dict[str, Any]
    """The scene with the fitted parameters, its static solver, and selections as node lists."""
    method: str
    """`tangent`: exact derivatives; `differences`: of equilibria solved again. With the reason."""
    solves: int
    """Equilibria that were computed."""
    converged: bool
    """Whether no step lowers the misfit any more, to first order, and no parameter ran away."""
    message: str
    """Why the search ended."""

    def __str__(self) -> str:
        lines = [f"{'parameter':32} {'value':>13} {'standard error':>15}   95 % confidence"]
        for path, value in self.values.items():
            low, high = self.confidence[path]
            lines.append(f"{path:32} {value:13.6g} {self.standard_errors[path]:15.3g}   {low:.6g} to {high:.6g}")
        lines.append(f"rms {self.rms * 1e3:.4g} mm, {self.solves} equilibria, {self.method}; {self.message}")
        return "\n".join(lines)


class Misfit:
    """Computed minus measured places as a function of the parameters (P,), with its derivative.

    `scene`: dict, path or Scene; `nodes` (m,) and `measured` (m, 3) m; `method`: `auto`, `tangent` or `differences`.
    `auto` takes differences where the residual in Python is not the engine's, and says why in `method`.
    """

    def __init__(
        self, scene: Any, nodes: NDArray[np.intp], measured: Array, paths: Sequence[str], method: str = "auto"
    ) -> None:
        given = _as_dict(scene)
        name_moduli(given, paths)
        frozen = with_selected_nodes(given, np.asarray(rest_world(given).positions()))
        settings = {key: value for key, value in frozen.get("solver", {}).items() if key == "element"}
        frozen["solver"] = settings | {"integrator": "static", "tolerance": 1e-9}
        for key in ("events", "outputs", "checkpoints", "recorded"):
            frozen.pop(key, None)
        self.nodes, self.measured, self.paths = nodes, measured, list(paths)
        self.initial = np.array([get_number(frozen, path) for path in self.paths])
        self.equilibrium = Equilibrium(frozen, self.paths)
        self.solves = 0
        self._solved: dict[bytes, Array] = {}
        self.method = self._choose(method)

    def _choose(self, method: str) -> str:
        if method not in ("auto", "tangent", "differences"):
            raise heml.InputError(f"method {method!r}: it is auto, tangent or differences")
        if method == "differences":
            return "differences"
        reason = unsupported(self.equilibrium.scene) or self._disagreement()
        if reason and method == "tangent":
            raise heml.InputError(f"method tangent: {reason}; take differences")
        return f"differences ({reason})" if reason else "tangent"

    def _disagreement(self) -> str | None:
        """Whether the engine's equilibrium is one of the residual that is differentiated."""
        scene = self.equilibrium.scene_at(self.initial)
        residual = self.equilibrium.residual(scene, self.positions(self.initial))
        free = self.equilibrium.free
        relative = np.linalg.norm(residual[free]) / max(float(np.linalg.norm(residual)), 1e-12)
        return f"relative residual in Python {relative:.1e}" if relative > _agreement else None

    def positions(self, values: Array) -> Array:
        """The equilibrium (V, 3), m. Raises NotConverged."""
        key = values.tobytes()
        if key not in self._solved:
            self.solves += 1
            if len(self._solved) > 4:
                self._solved.pop(next(iter(self._solved)))
            self._solved[key] = np.asarray(heml.solve(heml.Scene(self.equilibrium.scene_at(values)))[0])
        return self._solved[key]

    def residuals(self, values: Array) -> Array:
        """(m, 3) m: computed minus measured."""
        return self.positions(values)[self.nodes] - self.measured

    def jacobian(self, values: Array, steps: Array) -> Array:
        """(m, 3, P): derivative of the residuals."""
        if self.method == "tangent":
            whole = self.equilibrium.sensitivities(values, _fine * steps, self.positions(values))
            return np.moveaxis(whole[:, self.nodes], 0, -1)
        columns = []
        for j, step in enumerate(steps):
            shift = np.zeros_like(values)
            shift[j] = step
            columns.append((self.residuals(values + shift) - self.residuals(values - shift)) / (2 * step))
        return np.stack(columns, axis=-1)


def fit(
    scene: Any,
    observations: Mapping[str, Any],
    parameters: Union[Mapping[str, Any], Sequence[str]],
    *,
    method: str = "auto",
    max_iterations: int = 50,
) -> FitResult:
    """Fits numbers of a scene to measured places of nodes in its static equilibrium.

    The sum of squares is minimised by Gauss-Newton steps in a trust region (scipy). Derivatives of the equilibrium
    come from its exact tangent stiffness, factored once a step; where the scene has contacts, pressures, averaged
    nodal pressure or parameters by element, from equilibria solved again at parameters 0.1 % away.

    Args:
        scene: path, dict or heml.Scene. Loads act in full; events are left out.
        observations: `nodes` (m,), in the order of the mesh file; `positions` (m, 3), m; optionally `sigma`, the
            standard deviation of a coordinate, m: a number, (m,) or (m, 3). Without it sigma is estimated from the
            residuals.
        parameters: paths such as `materials[0].young`, `loads[0].force[2]`, `gravity[1]`, `boundary[1].translate[0]`,
            `mesh.scale`; or a dict from path to initial value, or to (initial, lower, upper). Without a value the
            search begins at that of the scene. Numbers of materials and `mesh.scale` that begin above 0 stay
            above 0; Poisson's ratio stays between -1 and 0.5.
        method: `auto`, `tangent` (an error where it does not hold) or `differences`.
        max_iterations: evaluations of the misfit at most.

    Returns:
        FitResult. `print(result)` shows a table.

    Raises:
        InputError: observations of wrong shape, unknown paths.
        NotConverged: no equilibrium at the initial values.
    """
    require("scipy.optimize", "fit")
    given = _as_dict(scene)
    named = _named(parameters)
    name_moduli(given, named)
    bounds = {path: _bounds(given, path, value) for path, value in named.items()}
    nodes, measured, sigma = _observed(observations)
    for path, (initial, _, _) in bounds.items():
        set_number(given, path, initial)
    misfit = Misfit(given, nodes, measured, list(bounds), method)
    if nodes.max() >= len(misfit.equilibrium.rest):
        raise heml.InputError(f"observations: node {nodes.max()}; the mesh has {len(misfit.equilibrium.rest)} nodes")
    search = _Search(misfit, list(bounds.values()), np.ones((1, 3)) if sigma is None else sigma)
    misfit.positions(search.values(search.start))
    found, problem = _least(search, search.start, max_iterations)
    if problem and search.logarithmic.sum() > 1:
        again, still = _least(search, _common_multiple(search, max_iterations), max_iterations)
        if not still or again.cost < found.cost:
            found, problem = again, still
    return _result(misfit, search, found, problem, sigma)


def _least(search: _Search, start: Array, max_iterations: int) -> tuple[Any, str | None]:
    """Where a search from `start` ends, and why that is no solution."""
    optimize = require("scipy.optimize", "fit")
    found = optimize.least_squares(
        search.residuals, start, search.jacobian, search.bounds, x_scale="jac", max_nfev=max_iterations,
        ftol=1e-12, xtol=1e-9, gtol=1e-12,
    )  # fmt: skip
    return found, _problem(search, found)


def _common_multiple(search: _Search, max_iterations: int) -> Array:
    """The start with all parameters that stay positive multiplied by the factor that fits best (P,): how stiff a body is
    as a whole places tell first, and far from that its derivatives mislead."""
    optimize = require("scipy.optimize", "fit")
    shared = search.logarithmic.astype(float)
    room = [np.min(np.abs(bound - search.start)[search.logarithmic]) for bound in search.bounds]
    found = optimize.least_squares(
        lambda t: search.residuals(search.start + t * shared), [0.0],
        lambda t: (search.jacobian(search.start + t * shared) @ shared)[:, None], (-room[0], room[1]),
        max_nfev=max_iterations, ftol=1e-4, xtol=1e-4,
    )  # fmt: skip
    return search.start + found.x * shared


class _Search:
    """The misfit in units of sigma, as a function of logarithms of those parameters that stay positive."""

    def __init__(self, misfit: Misfit, bounds: list[Bounds], sigma: Array) -> None:
        initial, lower, upper = (np.array(column) for column in zip(*bounds))
        self.misfit, self.sigma = misfit, sigma
        self.logarithmic = (lower >= 0) & (initial > 0)
        self.lower, self.upper = lower, upper
        self.scale = np.where(initial != 0, np.abs(initial), np.where(np.isfinite(upper - lower), upper - lower, 1.0))
        self.start = self._coordinates(initial)
        reach = np.where(self.logarithmic, _reach, np.inf)
        self.bounds = (
            np.maximum(self._coordinates(lower), self.start - reach),
            np.minimum(self._coordinates(upper), self.start + reach),
        )

    def _coordinates(self, values: Array) -> Array:
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(self.logarithmic, np.log(values), values / self.scale)

    def values(self, coordinates: Array) -> Array:
        with np.errstate(over="ignore"):
            return np.where(self.logarithmic, np.exp(coordinates), coordinates * self.scale)

    def slopes(self, values: Array) -> Array:
        """Change of the parameters by the coordinates (P,)."""
        return np.where(self.logarithmic, values, self.scale)

    def residuals(self, coordinates: Array) -> Array:
        try:
            return (self.misfit.residuals(self.values(coordinates)) / self.sigma).ravel()
        except (heml.NotConverged, heml.InputError):  # the trust region shrinks
            return np.full(self.misfit.measured.size, np.inf)

    def steps(self, values: Array) -> Array:
        room = np.minimum(values - self.lower, self.upper - values)
        return np.minimum(_step * np.where(values != 0, np.abs(values), self.scale), room / 4)

    def jacobian(self, coordinates: Array) -> Array:
        values = self.values(coordinates)
        jacobian = self.misfit.jacobian(values, self.steps(values)) / self.sigma[..., None]
        return jacobian.reshape(-1, len(values)) * self.slopes(values)


def _result(misfit: Misfit, search: _Search, found: Any, problem: str | None, sigma: Array | None) -> FitResult:
    special = require("scipy.special", "fit")
    values = search.values(found.x)
    slopes = search.slopes(values)
    residuals = misfit.residuals(values)
    freedom = residuals.size - len(values)
    variance = 1.0 if sigma is not None else float(np.sum(residuals**2)) / max(freedom, 1)
    covariance = _covariance(found.jac, misfit.paths, slopes, variance)
    errors = np.sqrt(np.diag(covariance))
    quantile = special.ndtri(0.975) if sigma is not None else special.stdtrit(max(freedom, 1), 0.975)
    return FitResult(
        values=dict(zip(misfit.paths, map(float, values))),
        standard_errors=dict(zip(misfit.paths, map(float, errors))),
        confidence={
            path: (float(value - quantile * error), float(value + quantile * error))
            for path, value, error in zip(misfit.paths, values, errors)
        },
        covariance=covariance,
        jacobian=(found.jac / slopes).reshape(len(misfit.nodes), 3, -1) * search.sigma[..., None],
        gradient=found.grad / slopes,
        residuals=residuals,
        rms=float(np.sqrt(np.mean(residuals**2))),
        positions=misfit.positions(values),
        scene=misfit.equilibrium.scene_at(values),
        method=misfit.method,
        solves=misfit.solves,
        converged=problem is None,
        message=problem or str(found.message),
    )


def _problem(search: _Search, found: Any) -> str | None:
    """Why the place where a search ended is no solution."""
    far = search.logarithmic & (np.abs(found.x - search.start) > _far)
    if far.any():
        gone = ", ".join(path for path, is_far in zip(search.misfit.paths, far) if is_far)
        return f"{gone} ran away from where it began: give bounds, or begin nearer to the solution"
    if not found.success:
        return str(found.message)
    return None if _is_least(found) else _not_least


def _is_least(found: Any) -> bool:
    """Whether the linearised misfit falls no further, so that the search did not end for want of equilibria around."""
    free = found.active_mask == 0
    step = np.linalg.lstsq(found.jac[:, free], -found.fun, rcond=1e-10)[0]
    left = found.fun + found.jac[:, free] @ step
    before = float(found.fun @ found.fun)
    return before - float(left @ left) <= _little * before or float(np.abs(step).max(initial=0)) <= _short


def _covariance(jacobian: Array, paths: list[str], slopes: Array, variance: float) -> Array:
    """Of the parameters, (P, P): variance times the inverse of J^T J, J by coordinates; inf with a warning where J is rank
    deficient."""
    scale = np.linalg.norm(jacobian, axis=0)
    singular = np.linalg.svd(jacobian / np.where(scale > 0, scale, 1), compute_uv=False)
    if scale.min() == 0 or singular[-1] < 1e-6 * singular[0]:
        warnings.warn(f"the observations do not determine {', '.join(paths)} separately", stacklevel=4)
        return np.full((len(paths), len(paths)), np.inf)
    scaled = jacobian / scale
    return variance * np.linalg.inv(scaled.T @ scaled) * np.outer(slopes / scale, slopes / scale)


def _as_dict(scene: Any) -> dict[str, Any]:
    return (scene if isinstance(scene, heml.Scene) else heml.Scene(scene)).to_dict()


def _named(parameters: Union[Mapping[str, Any], Sequence[str]]) -> dict[str, Any]:
    if isinstance(parameters, str):
        raise heml.InputError(f"parameters: a list of paths or a dict; write ['{parameters}']")
    paths = list(parameters)
    for path in paths:
        if paths.count(path) > 1:
            raise heml.InputError(f"parameter {path}: is given twice; give it once")
    named = dict(parameters) if isinstance(parameters, Mapping) else {path: None for path in paths}
    if not named:
        raise heml.InputError("parameters: none given; write for example ['materials[0].young']")
    return named


def _bounds(scene: dict[str, Any], path: str, value: Any) -> Bounds:
    """Initial value, lower and upper bound of a parameter."""
    present = get_number(scene, path)
    if value is not None and np.size(value) == 3:
        initial, lower, upper = (float(number) for number in value)
        if not lower < initial < upper:
            raise heml.InputError(f"parameter {path}: initial {initial:g} is not between {lower:g} and {upper:g}")
        return initial, lower, upper
    initial = present if value is None else float(value)
    if not np.isfinite(initial):
        raise heml.InputError(f"parameter {path}: the initial value is {initial:g}; give a finite number")
    if path.endswith(".poisson"):
        return initial, -1.0, 0.5
    positive = initial > 0 and (path.startswith("materials[") or path == "mesh.scale")
    return initial, 0.0 if positive else -np.inf, np.inf


def _observed(observations: Mapping[str, Any]) -> tuple[NDArray[np.intp], Array, Array | None]:
    unknown = set(observations) - {"nodes", "positions", "sigma"}
    if unknown or not {"nodes", "positions"} <= set(observations):
        raise heml.InputError(f"observations: keys are nodes, positions and sigma, not {sorted(observations)}")
    nodes = np.asarray(observations["nodes"])
    measured = _numbers(observations, "positions")
    if nodes.ndim != 1 or nodes.size == 0 or nodes.dtype.kind not in "iu" or nodes.min() < 0:
        raise heml.InputError("observations.nodes: a list of whole numbers >= 0")
    if measured.shape != (len(nodes), 3):
        raise heml.InputError(f"observations.positions: shape ({len(nodes)}, 3), not {measured.shape}")
    for row in np.flatnonzero(~np.isfinite(measured).all(axis=1)):
        raise heml.InputError(
            f"observations.positions[{row}]: of node {nodes[row]} is {measured[row].tolist()}; give finite numbers, and "
            "leave out nodes that were not measured"
        )
    return nodes.astype(np.intp), measured, _sigma(observations, len(nodes))


def _numbers(observations: Mapping[str, Any], key: str) -> Array:
    try:
        return np.asarray(observations[key], dtype=float)
    except (TypeError, ValueError):
        raise heml.InputError(f"observations.{key}: an array of numbers") from None


def _sigma(observations: Mapping[str, Any], count: int) -> Array | None:
    if observations.get("sigma") is None:
        return None
    sigma = _numbers(observations, "sigma")
    if sigma.ndim == 1:
        sigma = sigma[:, None]
    try:
        sigma = np.broadcast_to(sigma, (count, 3))
    except ValueError:
        raise heml.InputError(f"observations.sigma: a number, ({count},) or ({count}, 3)") from None
    if not ((sigma > 0) & np.isfinite(sigma)).all():
        wrong = sigma[~((sigma > 0) & np.isfinite(sigma))][0]
        raise heml.InputError(f"observations.sigma: finite and greater than 0, not {wrong:g}")
    return np.array(sigma)
