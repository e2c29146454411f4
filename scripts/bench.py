#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders scenes with brume's settings and with the textbook's, turn by turn, and says what each
picture cost and how good it became.

    scripts/bench.py --brume build/release/bin/brume --out docs/performance [--scene NAME]...

Efficiency is 1 / (MSE x user seconds of rendering). MSE is relative to the squared mean radiance and
comes from the differences between pictures of different seeds. Both configurations get the seconds
that loading takes subtracted. Needs nothing but Python's standard library.
"""
import argparse
import itertools
import json
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
        "fog": ([ROOT / "scenes/cornell_box_spheres_area_lights_fog.xml", "--size", "128x128"], 64, 64),
        "god rays": ([ROOT / "scenes/cornell_box_spheres_god_rays.xml", "--size", "128x128"], 64, 64),
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
    """Sums over rounds of one configuration, whose pictures are kept."""

    def __init__(self, brume, name, folder, spp, settings):
        self.brume, self.name, self.folder = brume, name, folder
        self.spp, self.settings = spp, settings
        self.seconds = self.memory = 0.0
        self.pictures = []

    def add_round(self, arguments):
        seed = len(self.pictures)
        loading, _, _ = run(self.brume, [*arguments, "--max-depth", "1"], self.folder, 1, seed,
                            self.settings)
        seconds, _, memory = run(self.brume, arguments, self.folder, self.spp, seed, self.settings)
        self.seconds += max(seconds - loading, 1e-3)
        self.memory = max(self.memory, memory)
        self.pictures.append(self.folder / f"{self.name}_{seed}.exr")
        (self.folder / "picture.exr").rename(self.pictures[-1])

    def seconds_per_spp(self):
        return self.seconds / (len(self.pictures) * self.spp)

    def mse_times_spp(self):
        """Two pictures of independent errors differ by twice the MSE of either."""
        squares = []
        for a, b in itertools.combinations(self.pictures, 2):
            subprocess.run([self.brume, "compare", a, b, "--json", self.folder / "compare.json"],
                           check=True, stdout=subprocess.DEVNULL)
            comparison = json.loads((self.folder / "compare.json").read_text())
            squares.append(0.5 * comparison["relative_rmse"] ** 2)
        return self.spp * sum(squares) / len(squares)


def measure(brume, arguments, folder, spp, textbook_spp, rounds):
    fast = Cost(brume, "fast", folder, spp, ())
    textbook = Cost(brume, "textbook", folder, textbook_spp, ("textbook",))
    for _ in range(rounds):
        for cost in (fast, textbook):
            cost.add_round(arguments)
    return fast, textbook


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--brume", default=str(ROOT / "build/release/bin/brume"))
    parser.add_argument("--scene", action="append", help="only this one; may be repeated")
    parser.add_argument("--rounds", type=int, default=4)
    parser.add_argument("--procedural", type=int, default=512, help="voxels a side; 0: none")
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
            mse, textbook_mse = fast.mse_times_spp(), textbook.mse_times_spp()
            ratio = (textbook.seconds_per_spp() * textbook_mse
                     / (fast.seconds_per_spp() * mse))
            rows.append((scene, ratio))
            lines.append(f"| {scene} | {micro * fast.seconds_per_spp():.2f} "
                         f"| {micro * textbook.seconds_per_spp():.2f} | {mse:.3g} "
                         f"| {textbook_mse:.3g} | {fast.memory:.0f} | {ratio:.1f} |")
            print(lines[-1], flush=True)
    print("\n".join(lines))
    print(f"{platform.machine()}, {os.cpu_count()} processors")
    if options.out:
        pathlib.Path(options.out + ".md").write_text("\n".join(lines) + "\n")
        pathlib.Path(options.out + ".svg").write_text(
            bars("efficiency over the textbook's", rows))


if __name__ == "__main__":
    main()
