#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders scenes with brume's settings and with the textbook's, turn by turn, and says what each
picture cost and how good it became.

    scripts/bench.py --brume build/release/bin/brume --out docs/performance [--scene NAME]...

Efficiency is 1 / (MSE x user seconds of rendering). MSE is the relative mean square error that the
pictures' own standard errors state, averaged over rounds with different seeds; one picture of each
scene is held against a picture with 16 times its samples, as a check on that. Both configurations
get the seconds that loading takes subtracted. Needs nothing but Python's standard library.
"""
import argparse
import json
import math
import os
import pathlib
import platform
import subprocess
import tempfile

from measure import ROOT, SAMPLES, bars, run, volume_noise

HAZE = """<scene version="3.0.0">
  <integrator type="volpath"/>
  <sensor type="perspective"><float name="fov" value="40"/>
    <transform name="to_world"><lookat origin="0, 0, -6" target="0, 0, 0" up="0, 1, 0"/></transform>
    <film type="hdrfilm"><rfilter type="box"/></film></sensor>
  <medium type="homogeneous"><float name="sigma_t" value="0.02"/><float name="albedo" value="0.9"/>
    <phase type="hg"><float name="g" value="0.5"/></phase></medium>
  <shape type="sphere"><point name="center" x="0.4" y="0.3" z="0"/><float name="radius" value="0.05"/>
    <emitter type="area"><rgb name="radiance" value="400, 380, 300"/></emitter></shape>
</scene>"""

CONSTANT = """<scene version="3.0.0">
  <integrator type="volpath"/>
  <sensor type="perspective"><float name="fov" value="30"/>
    <transform name="to_world"><lookat origin="1.6, 1.2, -2" target="0.5, 0.5, 0.5" up="0, 1, 0"/>
    </transform><film type="hdrfilm"><rfilter type="box"/></film></sensor>
  <medium type="heterogeneous"><float name="scale" value="40"/><float name="albedo" value="0.99"/>
    <volume name="sigma_t" type="vdb"><string name="filename" value="{media}/constant.vdb"/></volume>
    <phase type="hg"><float name="g" value="0.6"/></phase></medium>
  <emitter type="directional"><vector name="direction" x="0.5" y="-1" z="0.4"/>
    <rgb name="irradiance" value="3, 3, 3"/></emitter>
  <emitter type="constant"><rgb name="radiance" value="0.3, 0.4, 0.6"/></emitter>
</scene>"""


def scenes(folder, procedural_size):
    """Name: (arguments, samples a pixel, samples a pixel of the textbook) of what can be rendered."""
    (folder / "haze.xml").write_text(HAZE)
    (folder / "constant.xml").write_text(CONSTANT.replace("{media}", str(ROOT / "media")))
    found = {
        "fog": ([ROOT / "scenes/cornell_box_spheres_area_lights_fog.xml", "--size", "64x64"], 64, 64),
        "god rays": ([ROOT / "scenes/cornell_box_spheres_god_rays.xml", "--size", "64x64"], 64, 64),
        "haze, small lamp": ([folder / "haze.xml", "--size", "96x72"], 64, 64),
        "constant grid": ([folder / "constant.xml", "--size", "64x48"], 64, 32),
        "cumulus": ([ROOT / "scenes/vdb_cloud_sun_sky.xml", "--size", "72x48"], 64, 16),
    }
    if procedural_size:
        volume_noise(folder / "procedural.vol", procedural_size)
        found[f"procedural {procedural_size}^3"] = (
            [folder / "procedural.vol", "--albedo", "0.995", "--g", "0.8", "--size", "64x48",
             "--density-scale", "60"], 64, 16)
    for name, file, more, spp in (
            ("Disney cloud", "wdas_cloud_sixteenth.vdb",
             ["--albedo", "0.999", "--g", "0.85", "--density-scale", "2", "--size", "48x36"],
             (64, 16)),
            ("smoke", "openvdb_smoke_v222.vdb", ["--size", "64x48"], (64, 32))):
        if (SAMPLES / file).exists():
            found[name] = ([SAMPLES / file, *more], *spp)
        else:
            print(f"skipped: {name} ({SAMPLES / file} is not there)")
    return found


class Cost:
    """Sums over rounds of one configuration."""

    def __init__(self):
        self.seconds = self.variance = self.rounds = self.samples = 0.0
        self.memory = 0.0

    def add(self, seconds, statistics, memory, spp):
        self.seconds += seconds
        self.samples += spp
        self.variance += spp * statistics["relative_rms_error"] ** 2
        self.rounds += 1
        self.memory = max(self.memory, memory)

    def seconds_per_spp(self):
        return self.seconds / self.samples

    def mse_per_spp(self):
        return self.variance / self.rounds

    def efficiency(self):
        return 1.0 / (self.seconds_per_spp() * self.mse_per_spp())


def measure(brume, arguments, folder, spp, textbook_spp, rounds):
    fast, textbook = Cost(), Cost()
    for seed in range(rounds):
        for cost, count, settings in ((fast, spp, ()), (textbook, textbook_spp, ("textbook",))):
            loading, _, _ = run(brume, [*arguments, "--max-depth", "1"], folder, 1, seed, settings)
            seconds, statistics, memory = run(brume, arguments, folder, count, seed, settings)
            cost.add(max(seconds - loading, 1e-3), statistics, memory, count)
    return fast, textbook


def check_error(brume, arguments, folder, spp):
    """RMSE against a picture of 16 times the samples, over what the standard errors of both say."""
    _, many, _ = run(brume, arguments, folder, 16 * spp, 1000)
    (folder / "picture.exr").rename(folder / "reference.exr")
    _, few, _ = run(brume, arguments, folder, spp, 2000)
    subprocess.run([brume, "compare", folder / "picture.exr", folder / "reference.exr", "--json",
                    folder / "compare.json"], check=True, stdout=subprocess.DEVNULL)
    comparison = json.loads((folder / "compare.json").read_text())
    expected = math.hypot(many["relative_rms_error"], few["relative_rms_error"])
    mean = sum(comparison["reference_mean"]) / len(comparison["reference_mean"])
    return comparison["rmse"] / mean / expected


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--brume", default=str(ROOT / "build/release/bin/brume"))
    parser.add_argument("--scene", action="append", help="only this one; may be repeated")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--procedural", type=int, default=512, help="voxels a side; 0: none")
    parser.add_argument("--check", action="store_true", help="also check the stated errors")
    parser.add_argument("--out", help="write OUT.md and OUT.svg")
    options = parser.parse_args()

    rows, lines = [], [
        "| scene | us a sample | textbook | MSE x samples | textbook | memory [MB] | efficiency ratio |",
        "|---|--:|--:|--:|--:|--:|--:|"]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for scene, (arguments, spp, textbook_spp) in scenes(folder, options.procedural).items():
            if options.scene and scene not in options.scene:
                continue
            fast, textbook = measure(options.brume, arguments, folder, spp, textbook_spp,
                                     options.rounds)
            width, pixels = map(int, str(arguments[arguments.index("--size") + 1]).split("x"))
            micro = 1e6 / (width * pixels)
            ratio = fast.efficiency() / textbook.efficiency()
            rows.append((scene, ratio))
            lines.append(f"| {scene} | {micro * fast.seconds_per_spp():.2f} "
                         f"| {micro * textbook.seconds_per_spp():.2f} | {fast.mse_per_spp():.3g} "
                         f"| {textbook.mse_per_spp():.3g} | {fast.memory:.0f} | {ratio:.1f} |")
            print(lines[-1], flush=True)
            if options.check:
                print(f"  RMSE over stated error: "
                      f"{check_error(options.brume, arguments, folder, spp):.2f}", flush=True)
    print("\n".join(lines))
    print(f"{platform.machine()}, {os.cpu_count()} processors")
    if options.out:
        pathlib.Path(options.out + ".md").write_text("\n".join(lines) + "\n")
        pathlib.Path(options.out + ".svg").write_text(
            bars("efficiency over the textbook's", rows))


if __name__ == "__main__":
    main()
