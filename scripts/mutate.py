#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plants one bug at a time in a copy of the tree and checks that the test of its law fails.

Usage: scripts/mutate.py [NUMBER...]    all mutations below, or those numbered

Prints a table for docs/validation.md. A mutation that no test notices, or that no longer fits the
code, is an error. BRUME_MUTANTS names a folder for the copy and its build, to be kept; otherwise
both are temporary.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
from typing import NamedTuple


class Mutation(NamedTuple):
    law: str
    bug: str  # in words
    file: str
    old: str
    new: str
    test: str  # gtest filter


MUTATIONS = [
    Mutation("slabs, distance sampling", "mean free paths 1% short",
             "src/medium/homogeneous_medium.cpp",
             "-std::log1p(-u) / sigma_t", "-0.99f * std::log1p(-u) / sigma_t",
             "Slab.NormalIncidence/g_0_albedo_0p9_tau_2"),
    Mutation("slabs, backward scattering", "the sign of g is lost where the phase function is evaluated",
             "src/phase/henyey_greenstein.h",
             "one_minus_cos(d, g < 0.0f ? -d_out : d_out)", "one_minus_cos(d, d_out)",
             "Slab.NormalIncidence/g_m0p8_albedo_1_tau_2"),
    Mutation("slabs, diffuse light", "inverse CDF with the prefactor g/2 of the misprint",
             "src/phase/henyey_greenstein.h",
             "std::copysign(1.0f, g) * cos_theta", "g * a * cos_theta",
             "Slab.DiffuseLight/g_m0p8_albedo_1_tau_2"),
    Mutation("van de Hulst's slab", "scattered light keeps the albedo twice",
             "src/medium/homogeneous_medium.cpp",
             ".weight = albedo_ * pdf", ".weight = albedo_ * albedo_ * pdf",
             "Hulst.IsotropicSlabAtSixtyDegrees"),
    Mutation("van de Hulst's angles", "shadow rays roulette without compensation",
             "src/integrator/path_integrator.cpp",
             "(value / p_trace)", "value",
             "HulstAngles.RadianceIsThatOfTheTable/5"),
    Mutation("half-space, H function", "roulette of paths without compensation",
             "src/integrator/path_integrator.cpp",
             "path.beta /= p_survive;", "",
             "HalfSpaceAlbedo.FollowsTheHFunction/5"),
    Mutation("half-space, Giovanelli", "Fresnel reflectance of one polarisation",
             "src/material/fresnel.cpp",
             ".R = 0.5f * (r_s * r_s + r_p * r_p)", ".R = r_s * r_s",
             "HalfSpace.BehindGlassReflectsWhatGiovanelliFound"),
    Mutation("Beer-Lambert in grids", "interpolation weights of two axes exchanged",
             "src/volume/grid.h",
             "i.z + (rng.next_float() < f.z)", "i.z + (rng.next_float() < f.x)",
             "BeerLambert.HoldsInGrids/*"),
    Mutation("Beer-Lambert in grids", "ratio tracking steps by the majorant, not by its residual",
             "src/medium/heterogeneous_medium.cpp",
             "t += tau / residual;", "t += tau / sigma_maj;",
             "BeerLambert.HoldsInGrids/*"),
    Mutation("single scattering, point light", "inverse distance in place of its square",
             "src/light/toward.h",
             "1.0 / (distance * distance)", "1.0 / distance",
             "SingleScattering.OfAPointLight/0"),
    Mutation("single scattering, spot light", "falloff squared",
             "src/light/spot_light.cpp",
             "intensity_ * (fraction * toward", "intensity_ * (fraction * fraction * toward",
             "SingleScattering.OfASpotLight/0"),
    Mutation("single scattering, directional light", "phase function of the reversed direction",
             "src/integrator/path_integrator.cpp",
             "const float value = flight.phase.eval(d, arrival->light.d);",
             "const float value = flight.phase.eval(-d, arrival->light.d);",
             "SingleScattering.OfADirectionalLightInABoundedFog/1"),
    Mutation("single scattering, rectangle", "solid-angle density 2% low",
             "src/geometry/rectangle.cpp",
             "1.0 / seen->solid_angle())}", "0.98 / seen->solid_angle())}",
             "SingleScattering.OfARectangle/0"),
    Mutation("single scattering, sphere", "area lights shine inward too",
             "src/light/area_light.h",
             "glm::dot(d, hit.n) < 0.0f ? radiance_ : Rgb{0.0f}", "radiance_",
             "PointSourceFluence.IsThatOfTheExactSolution/0"),
    Mutation("single scattering, occluder", "shadow rays end 1 short of the light",
             "src/light/point_light.cpp",
             ".distance = static_cast<float>(toward.distance)",
             ".distance = static_cast<float>(0.4 * toward.distance)",
             "SingleScattering.OfAPointLightBehindAnOccluder/0"),
    Mutation("point source", "equiangular density 10% high",
             "src/integrator/segment_lighting.cpp",
             "return height / (", "return 1.1 * height / (",
             "PointSourceFluence.IsThatOfTheExactSolution/0"),
    Mutation("mean path length", "one channel's albedo for all",
             "src/medium/homogeneous_medium.cpp",
             ".weight = albedo_ * pdf", ".weight = albedo_.g * pdf",
             "MeanPathLength.IsFourVolumesOverTheSurface/0"),
    Mutation("crossing a sphere", "exponent of the transmittance 1% low",
             "src/medium/homogeneous_medium.cpp",
             "glm::exp(-sigma_t_ *", "glm::exp(-0.99f * sigma_t_ *",
             "Crossing.FractionThatPassesASphere/1"),
    Mutation("white furnace", "weights of the two ways to find the environment add to more than 1",
             "src/integrator/path_integrator.cpp",
             "power_heuristic(arrival->light.pdf * mixture, value)",
             "power_heuristic(1.2f * arrival->light.pdf * mixture, value)",
             "WhiteFurnace.ShowsNothing/0"),
    Mutation("one slab, many representations", "bounds that stop short of the interpolation footprint",
             "src/volume/bounds_grid.cpp",
             "glm::ceil(box.max))", "glm::floor(box.max))",
             "Representations.GiveOneAnswer/*"),
    Mutation("scaling", "rays leave surfaces by a fixed 2e-4",
             "src/geometry/hit.h",
             "std::abs(cosine) < kGrazing ? error :", "true ? 2e-4f :",
             "Moved.SlabsLookTheSame/0"),
    Mutation("rotation", "an environment is turned the wrong way",
             "src/light/environment_map.cpp",
             "to_local_(glm::inverse(to_world_))", "to_local_(to_world_)",
             "Moved.SlabsLookTheSame/4"),
    Mutation("translation", "rays leave surfaces by a rounding of the whole width",
             "src/geometry/hit.h",
             "std::abs(cosine) < kGrazing ? error :", "true ? error :",
             "Moved.SlabsLookTheSame/6"),
    Mutation("reciprocity", "the diffuse material weighs with the cosine of the wrong direction",
             "src/material/diffuse_bsdf.cpp",
             "return reflectance_->value(uv) * (wi.z / kPi);",
             "return reflectance_->value(uv) * (wo.z / kPi);",
             "Reciprocity.*"),
]


def run(command, **options):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          **options)


def copied(root, copy):
    """Files that are tracked, with their changes."""
    for name in run(["git", "ls-files"], cwd=root, check=True).stdout.splitlines():
        if (root / name).is_file():
            (copy / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(root / name, copy / name)


def build(tree, folder):
    jobs = str(os.cpu_count())
    return run(["cmake", "--build", str(folder), "-j", jobs, "--target", "statistics_test"],
               cwd=tree)


def verdict(mutation, tree, folder):
    path = tree / mutation.file
    text = path.read_text()
    if text.count(mutation.old) != 1:
        return f"STALE: found {text.count(mutation.old)} times"
    path.write_text(text.replace(mutation.old, mutation.new))
    try:
        built = build(tree, folder)
        if built.returncode != 0:
            return "STALE: does not compile"
        try:
            test = run([str(folder / "bin/statistics_test"), "--gtest_filter=" + mutation.test],
                       timeout=1800)
        except subprocess.TimeoutExpired:
            return "caught (does not end)"
        if "[  PASSED  ] 0 tests" in test.stdout and "FAILED" not in test.stdout:
            return "STALE: the test is not run"
        return "caught" if test.returncode != 0 else "SURVIVED"
    finally:
        path.write_text(text)


def main():
    chosen = [int(a) for a in sys.argv[1:]] or range(1, len(MUTATIONS) + 1)
    root = pathlib.Path(__file__).resolve().parent.parent
    kept = os.environ.get("BRUME_MUTANTS")
    work = pathlib.Path(kept or tempfile.mkdtemp())
    tree, folder = work / "tree", work / "build"
    print("| | law | planted bug | test | result |\n|---|---|---|---|---|", flush=True)
    try:
        copied(root, tree)
        run(["cmake", "--preset", "checked", "-B", str(folder)], cwd=tree, check=True)
        sound = build(tree, folder)
        if sound.returncode != 0:
            sys.exit(sound.stdout)
        failures = 0
        for number in chosen:
            m = MUTATIONS[number - 1]
            result = verdict(m, tree, folder)
            failures += not result.startswith("caught")
            print(f"| {number} | {m.law} | {m.bug}: `{m.file}` | `{m.test}` | {result} |", flush=True)
    finally:
        if not kept:
            shutil.rmtree(work)
    sys.exit(failures > 0)


main()
