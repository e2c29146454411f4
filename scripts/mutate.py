#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plants bugs in a copy of the tree, one at a time, and checks that the test of each law fails.

Usage: scripts/mutate.py [NUMBER...]    all bugs below, or those numbered

All bugs are compiled at once, each behind a switch that the environment variable PLANTED_BUG turns
(mutant schemata, Untch et al. 1993), so that the copy is built once. Each test must pass with the
switch at 0 and fail with it at its bug. Prints a table for docs/validation.md. A bug that no test
notices, or that no longer fits the code, is an error. BRUME_MUTANTS names a folder for the copy and
its build, to be kept; otherwise both are temporary.
"""
import functools
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
from typing import NamedTuple


class Bug(NamedTuple):
    law: str
    bug: str  # in words
    file: str
    right: str  # an expression, in the file once
    wrong: str  # what is computed in its place
    test: str  # gtest filter
    followed_by: str = ""  # text that tells one occurrence of the expression from others
    program: str = "statistics_test"


BUGS = [
    Bug("slabs, distance sampling", "mean free paths 2% short",
        "src/medium/homogeneous_medium.cpp",
        "-std::log1p(-u) / sigma_t", "-0.98f * std::log1p(-u) / sigma_t",
        "Slab.NormalIncidence/g_0_albedo_0p9_tau_2"),
    Bug("slabs, backward scattering", "the sign of g is lost where the phase function is evaluated",
        "src/phase/henyey_greenstein.h",
        "one_minus_cos(d, g < 0.0f ? -d_out : d_out)", "one_minus_cos(d, d_out)",
        "Slab.NormalIncidence/g_m0p8_albedo_1_tau_2"),
    Bug("slabs, diffuse light", "inverse CDF with the prefactor g/2 of the misprint",
        "src/phase/henyey_greenstein.h",
        "std::copysign(1.0f, g) * cos_theta", "g * a * cos_theta",
        "Slab.DiffuseLight/g_m0p8_albedo_1_tau_2"),
    Bug("Henyey-Greenstein, mean cosine", "the sampled angle is mirrored for g < 0",
        "src/phase/henyey_greenstein.h",
        "1.0f - one_minus", "std::copysign(1.0f, g) * (1.0f - one_minus)",
        "Asymmetries/HenyeyGreensteinLaw.MeanCosineIsG/2", " :", "phase_test"),
    Bug("Henyey-Greenstein, distribution", "directions 5% nearer to the peak",
        "src/phase/henyey_greenstein.h",
        "2.0f * forward * forward * (1.0f - u.x) * (1.0f + a * u.x)",
        "1.8f * forward * forward * (1.0f - u.x) * (1.0f + a * u.x)",
        "Asymmetries/HenyeyGreensteinLaw.SamplesFollowTheCumulativeDistribution/9", ";",
        "phase_test"),
    Bug("Henyey-Greenstein, normalisation", "1 - g^2 as (1 - g)^2",
        "src/phase/henyey_greenstein.h",
        "(1.0f - a) * (1.0f + a) / (4.0f * kPi * denominator * std::sqrt(denominator))",
        "(1.0f - a) * (1.0f - a) / (4.0f * kPi * denominator * std::sqrt(denominator))",
        "Asymmetries/HenyeyGreensteinLaw.IntegratesToOne/2", ";", "phase_test"),
    Bug("van de Hulst's slab", "scattered light keeps the albedo twice",
        "src/medium/homogeneous_medium.cpp",
        "albedo_ * pdf / glm::dot(p_channel, pdf)",
        "albedo_ * albedo_ * pdf / glm::dot(p_channel, pdf)",
        "Hulst.IsotropicSlabAtSixtyDegrees"),
    Bug("van de Hulst's angles", "shadow rays roulette without compensation",
        "src/integrator/path_integrator.cpp",
        "(value / p_trace)", "value",
        "HulstAngles.RadianceIsThatOfTheTable/5"),
    Bug("half-space, H function", "roulette of paths without compensation",
        "src/integrator/path_integrator.cpp",
        "path.beta /= p_survive", "path.beta",
        "HalfSpaceAlbedo.FollowsTheHFunction/5"),
    Bug("half-space, light and view at angles", "the way to a light is 5% too long in media",
        "src/scene/scene.cpp",
        "hit ? hit->t : distance", "1.05f * (hit ? hit->t : distance)",
        "HalfSpaceReflection.FollowsTheHFunction/1", ");"),
    Bug("half-space, Giovanelli", "Fresnel reflectance of one polarisation",
        "src/material/fresnel.cpp",
        "0.5f * (r_s * r_s + r_p * r_p)", "r_s * r_s",
        "HalfSpace.BehindGlassReflectsWhatGiovanelliFound"),
    Bug("Beer-Lambert in grids", "interpolation weights of two axes exchanged",
        "src/medium/heterogeneous_medium.cpp",
        "voxels_.stochastic(p, rng)",
        "voxels_.stochastic(Vec3(p.x, p.y, std::floor(p.z) + p.x - std::floor(p.x)), rng)",
        "BeerLambert.HoldsInGrids/*"),
    Bug("Beer-Lambert in grids", "ratio tracking steps by the majorant, not by its residual",
        "src/medium/heterogeneous_medium.cpp",
        "tau / residual", "tau / sigma_maj",
        "BeerLambert.HoldsInGrids/*"),
    Bug("Beer-Lambert in a constant grid", "a box is left 0.1% too early",
        "src/volume/bounds_grid.cpp",
        "float(t1 - t0)", "float(0.999 * (t1 - t0))",
        "BeerLambertInAConstantGrid.IsExactAtAnyAngle"),
    Bug("single scattering, point light", "inverse distance in place of its square",
        "src/light/toward.h",
        "1.0 / (distance * distance)", "1.0 / distance",
        "SingleScattering.OfAPointLight/0"),
    Bug("single scattering, spot light", "falloff squared",
        "src/light/spot_light.cpp",
        "(fraction * toward.inverse_square())", "(fraction * fraction * toward.inverse_square())",
        "SingleScattering.OfASpotLight/0"),
    Bug("single scattering, directional light", "phase function of the reversed direction",
        "src/integrator/path_integrator.cpp",
        "flight.phase.eval(d, arrival->light.d)", "flight.phase.eval(-d, arrival->light.d)",
        "SingleScattering.OfADirectionalLightInABoundedFog/1"),
    Bug("single scattering, rectangle", "solid-angle density 2% low",
        "src/geometry/rectangle.cpp",
        "1.0 / seen->solid_angle()", "0.98 / seen->solid_angle()",
        "SingleScattering.OfARectangle/0", ")}"),
    Bug("single scattering, sphere", "density in the cone to a sphere 2% low",
        "src/geometry/sphere.cpp",
        "cone->pdf()", "0.98 * cone->pdf()",
        "SingleScattering.OfASphere/0", ")}"),
    Bug("single scattering, occluder", "shadow rays pass through what is opaque",
        "src/scene/scene.cpp",
        "queries_->is_occluded(ray, distance)", "false",
        "SingleScattering.OfAPointLightBehindAnOccluder/0"),
    Bug("single scattering, grid", "the nearest voxel in place of interpolation",
        "src/medium/heterogeneous_medium.cpp",
        "voxels_.stochastic(p, rng)", "lookup.nearest(p)",
        "SingleScattering.InAGridWithALinearRamp/*"),
    Bug("point source", "area lights shine inward too",
        "src/light/area_light.h",
        "glm::dot(d, hit.n) < 0.0f ? radiance_ : Rgb{0.0f}", "radiance_",
        "PointSourceFluence.IsThatOfTheExactSolution/0"),
    Bug("point source", "equiangular density 10% high",
        "src/integrator/segment_lighting.cpp",
        "height / ((theta_1 - theta_0) * (height * height + along * along))",
        "1.1 * height / ((theta_1 - theta_0) * (height * height + along * along))",
        "PointSourceFluence.IsThatOfTheExactSolution/0"),
    Bug("mean path length", "one channel's albedo for all",
        "src/medium/homogeneous_medium.cpp",
        "albedo_ * pdf / glm::dot(p_channel, pdf)", "albedo_.g * pdf / glm::dot(p_channel, pdf)",
        "MeanPathLength.IsFourVolumesOverTheSurface/0"),
    Bug("mean number of collisions in a grid", "what is there anyway collides twice",
        "src/medium/heterogeneous_medium.cpp",
        "u < sigma_c || u < sigma_t()", "u < sigma_c || u < sigma_c + sigma_t()",
        "MeanCollisions.InAGridAreFourTimesItsExtinctionOverTheSurface"),
    Bug("crossing a sphere", "exponent of the transmittance 1% low",
        "src/medium/homogeneous_medium.cpp",
        "-sigma_t_", "-0.99f * sigma_t_",
        "Crossing.FractionThatPassesASphere/1", " * std::min("),
    Bug("white furnace", "weights of the two ways to find the environment add to more than 1",
        "src/integrator/path_integrator.cpp",
        "power_heuristic(arrival->light.pdf * mixture, value)",
        "power_heuristic(1.2f * arrival->light.pdf * mixture, value)",
        "WhiteFurnace.ShowsNothing/0"),
    Bug("one slab, many representations", "bounds that stop short of the interpolation footprint",
        "src/volume/bounds_grid.cpp",
        "glm::ceil(box.max)", "glm::floor(box.max)",
        "Representations.GiveOneAnswer/*"),
    Bug("scaling", "rays leave surfaces by a fixed 2e-4",
        "src/geometry/hit.h",
        "std::abs(cosine) < kGrazing ? error : rounding_error(p, n, error)", "2e-4f",
        "Moved.SlabsLookTheSame/1"),
    Bug("rotation", "an environment is turned the wrong way",
        "src/light/environment_map.cpp",
        "glm::inverse(glm::dmat3(to_world))", "glm::dmat3(to_world)",
        "Moved.SlabsLookTheSame/4"),
    Bug("translation", "rays leave surfaces by a rounding of the whole width",
        "src/geometry/hit.h",
        "std::abs(cosine) < kGrazing ? error : rounding_error(p, n, error)", "error",
        "Moved.SlabsLookTheSame/6"),
    Bug("translation", "scenes far away stay far away",
        "src/io/scene_file.cpp",
        "std::max({away.x, away.y, away.z}) <= kFar * std::max({size.x, size.y, size.z})", "true",
        "Moved.SlabsLookTheSame/8"),
    Bug("reciprocity", "the diffuse material weighs with the cosine of the wrong direction",
        "src/material/diffuse_bsdf.cpp",
        "reflectance_->value(uv) * (wi.z / kPi)", "reflectance_->value(uv) * (wo.z / kPi)",
        "Reciprocity.*"),
    Bug("reciprocity", "flights find more to collide with than shadow rays",
        "src/medium/heterogeneous_medium.cpp",
        "u < sigma_c || u < sigma_t()", "u < sigma_c || u < sigma_c + sigma_t()",
        "Reciprocity.*"),
]

SWITCH = """#pragma once
#include <cstdlib>
inline const int planted_bug =
    std::getenv("PLANTED_BUG") == nullptr ? 0 : std::atoi(std::getenv("PLANTED_BUG"));
"""


def run(command, **options):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          **options)


def copied(root, copy):
    """Files that are tracked, with their changes."""
    for name in run(["git", "ls-files"], cwd=root, check=True).stdout.splitlines():
        if (root / name).is_file():
            (copy / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(root / name, copy / name)


def planted(tree):
    """Puts every bug beside what is right. Returns the numbers of those that do not fit the code."""
    wrongs = {}  # of each expression, since two bugs may sit in one
    for number, b in enumerate(BUGS, 1):
        wrongs.setdefault((b.file, b.right, b.followed_by), []).append((number, b.wrong))
    stale = set()
    for (file, right, followed_by), choices in wrongs.items():
        text = (tree / file).read_text()
        if text.count(right + followed_by) != 1:
            stale.update(number for number, _ in choices)
            continue
        switch = "".join(f"planted_bug == {number} ? ({wrong}) : " for number, wrong in choices)
        text = text.replace(right + followed_by, f"({switch}({right})){followed_by}")
        if "core/planted_bug.h" not in text:
            text = '#include "core/planted_bug.h"\n' + text
        (tree / file).write_text(text)
    (tree / "src/core/planted_bug.h").write_text(SWITCH)
    return stale


@functools.cache
def outcome(program, test_filter, number):
    """What a test says with the bug of that number planted; 0 is none."""
    test = run([str(program), "--gtest_filter=" + test_filter], timeout=1800,
               env=dict(os.environ, PLANTED_BUG=str(number)))
    if "[  PASSED  ] 0 tests" in test.stdout and "FAILED" not in test.stdout:
        return "not run"
    return "passes" if test.returncode == 0 else "fails"


def verdict(bug, number, folder):
    program = folder / "bin" / bug.program
    try:
        if (sound := outcome(program, bug.test, 0)) != "passes":
            return f"STALE: the test {sound} without the bug"
        return "caught" if outcome(program, bug.test, number) == "fails" else "SURVIVED"
    except subprocess.TimeoutExpired:
        return "UNKNOWN: takes more than half an hour"


def main():
    chosen = [int(a) for a in sys.argv[1:]] or range(1, len(BUGS) + 1)
    root = pathlib.Path(__file__).resolve().parent.parent
    kept = os.environ.get("BRUME_MUTANTS")
    work = pathlib.Path(kept or tempfile.mkdtemp())
    tree = work / "tree"
    folder = tree / "build/checked"  # where it always is, so that ccache knows what has no bug
    try:
        copied(root, tree)
        stale = planted(tree)
        run(["cmake", "--preset", "checked"], cwd=tree, check=True)
        programs = sorted({b.program for b in BUGS})
        built = run(["cmake", "--build", str(folder), "-j", str(os.cpu_count()), "--target",
                     *programs], cwd=tree)
        if built.returncode != 0:
            sys.exit(built.stdout)
        print("| | law | planted bug | test | result |\n|---|---|---|---|---|", flush=True)
        failures = 0
        for number in chosen:
            b = BUGS[number - 1]
            result = "STALE: no longer fits the code" if number in stale else \
                verdict(b, number, folder)
            failures += result != "caught"
            print(f"| {number} | {b.law} | {b.bug}: `{b.file}` | `{b.test}` | {result} |",
                  flush=True)
    finally:
        if not kept:
            shutil.rmtree(work)
    sys.exit(failures > 0)


main()
