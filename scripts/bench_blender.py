#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders the same volumes with brume and with Blender's Cycles, turn by turn, and says how much
computing either needs for the same error.

    scripts/bench_blender.py --out bench_blender        # writes bench_blender.md

Camera, sun, sky, density, albedo and g are the same; both pictures are linear, one pixel wide box
filter, no denoising, no clamping. First each renderer's reference is made and the two are compared.
Then MSE is measured against the renderer's own reference, over several seeds, and efficiency is
1 / (MSE x CPU seconds), less those of a render with one sample, which is loading. Needs a Blender
with OpenVDB: apt-get install --no-install-recommends blender
"""
import argparse
import json
import math
import os
import pathlib
import platform
import shutil
import subprocess
import tempfile

from measure import ROOT, SAMPLES

SCENE = """<scene version="3.0.0">
  <integrator type="volpath"/>
  <sensor type="perspective"><float name="fov" value="{fov}"/>
    <transform name="to_world"><lookat origin="{origin}" target="{target}" up="0, 1, 0"/></transform>
    <film type="hdrfilm"><rfilter type="box"/></film></sensor>
  <medium type="heterogeneous"><float name="scale" value="{scale}"/>
    <float name="albedo" value="{albedo}"/>
    <volume name="sigma_t" type="vdb"><string name="filename" value="{file}"/>
      <string name="grid" value="{grid}"/></volume>
    <phase type="hg"><float name="g" value="{g}"/></phase></medium>
  <emitter type="directional"><vector name="direction" value="{direction}"/>
    <rgb name="irradiance" value="{irradiance}"/></emitter>
  <emitter type="constant"><rgb name="radiance" value="{radiance}"/></emitter>
</scene>"""

# What scenes have in common; lengths are scene units, angles degrees.
COMMON = {"grid": "density", "direction": [0.75, -0.55, 0.35], "irradiance": [4.2, 3.9, 3.5],
          "radiance": [0.07, 0.13, 0.28]}

SCENES = {
    "cumulus": {"file": ROOT / "media/cloud.vdb", "fov": 38, "origin": [560, 660, 1750],
                "target": [20, 830, 0], "scale": 0.09, "albedo": 0.998, "g": 0.8},
    "smoke": {"file": SAMPLES / "openvdb_smoke_v222.vdb", "fov": 35, "origin": [107, 0, 254],
              "target": [-7.4, 40.5, 0.5], "scale": 1.6, "albedo": 0.99, "g": 0.75},
    "Disney cloud": {"file": SAMPLES / "wdas_cloud_sixteenth.vdb", "fov": 35,
                     "origin": [457, -95, 997], "target": [-12, 72, -45], "scale": 0.2,
                     "albedo": 0.999, "g": 0.85},
}
SCENES["Disney cloud, thick"] = {**SCENES["Disney cloud"], "scale": 2}


def run(command):
    """User seconds of a command that must succeed."""
    process = subprocess.Popen([*map(str, command)], stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE)
    message = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        raise SystemExit(f"failed: {' '.join(map(str, command))}\n{message.decode()}")
    return usage.ru_utime


class Brume:
    name = "brume"

    def __init__(self, options, folder):
        self.options, self.folder = options, folder

    def render(self, scene, spp, seed, picture):
        def text(value):
            return ", ".join(map(str, value)) if isinstance(value, list) else value

        path = self.folder / "scene.xml"
        path.write_text(SCENE.format(**{key: text(value) for key, value in scene.items()}))
        width, height = scene["size"]
        return run([self.options.brume, "render", path, "--size", f"{width}x{height}", "--spp", spp,
                    "--seed", seed, "--threads", 2, "--quiet", "-o", picture])


class Cycles:
    name = "Cycles"

    def __init__(self, options, folder):
        self.options, self.folder = options, folder

    def render(self, scene, spp, seed, picture):
        path = self.folder / "job.json"
        path.write_text(json.dumps(
            {**scene, "file": str(pathlib.Path(scene["file"]).resolve()), "spp": spp, "seed": seed,
             "threads": 2, "picture": str(picture), "step_rate": self.options.step_rate,
             "volume_sampling": self.options.volume_sampling,
             "sky_sampling": self.options.sky_sampling}))
        run([self.options.blender, "-b", "--factory-startup", "--python-exit-code", 1, "--python",
             ROOT / "scripts/blender_scene.py", "--", path])
        return json.loads((self.folder / "job.json.out").read_text())["seconds"]


def compare(brume, folder, picture, reference):
    run([brume, "compare", picture, reference, "--json", folder / "compare.json"])
    return json.loads((folder / "compare.json").read_text())


class Measured:
    """One renderer on one scene: its reference, and sums over seeds."""

    def __init__(self, renderer, scene, spp, reference_spp, folder):
        self.renderer, self.scene, self.spp = renderer, scene, spp
        self.reference_spp, self.folder = reference_spp, folder
        self.reference = folder / f"{renderer.name}.exr"
        self.seconds, self.squares, self.mean = [], [], 0.0

    def make_reference(self):
        self.renderer.render(self.scene, self.reference_spp, 1000, self.reference)

    def add(self, brume, seed):
        picture = self.folder / "picture.exr"
        loading = self.renderer.render(self.scene, 1, seed, picture)
        seconds = self.renderer.render(self.scene, self.spp, seed, picture)
        found = compare(brume, self.folder, picture, self.reference)
        self.mean = sum(found["reference_mean"]) / 3.0
        self.seconds.append((seconds - loading) * self.spp / (self.spp - 1))
        # The reference has an error of its own, as if it were one more picture.
        self.squares.append(found["rmse"] ** 2 / (1.0 + self.spp / self.reference_spp))

    def cost(self):
        return sum(self.seconds) / len(self.seconds)

    def mse(self):
        return sum(self.squares) / len(self.squares)

    def spread(self):
        """Relative standard error of the MSE over seeds."""
        n = len(self.squares)
        variance = sum((s - self.mse()) ** 2 for s in self.squares) / (n - 1)
        return math.sqrt(variance / n) / self.mse()

    def efficiency(self):
        return 1.0 / (self.cost() * self.mse())

    def row(self, scene):
        pixels = self.scene["size"][0] * self.scene["size"][1]
        return (f"| {scene} | {self.renderer.name} | {self.spp} | {self.cost():.2f} "
                f"| {1e6 * self.cost() / (pixels * self.spp):.2f} "
                f"| {100.0 * math.sqrt(self.mse()) / self.mean:.2f}% ± "
                f"{50.0 * self.spread():.0f}% | ")


def agreement(brume, folder, ours, theirs):
    """How far the two references are apart, and how much of that is their noise."""
    found = compare(brume, folder, theirs.reference, ours.reference)
    ratios = [a / b for a, b in zip(found["mean"], found["reference_mean"])]
    noise = math.sqrt(sum(m.mse() * m.spp / m.reference_spp for m in (ours, theirs))) / ours.mean
    apart = math.sqrt(max(found["relative_rmse"] ** 2 - noise ** 2, 0.0))
    return (f"mean radiance of Cycles over brume's {', '.join(f'{r:.3f}' for r in ratios)}; pixels "
            f"differ by {100 * found['relative_rmse']:.1f}% RMS, {100 * noise:.1f}% of that noise, "
            f"{100 * apart:.1f}% without it")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--brume", default=str(ROOT / "build/release/bin/brume"))
    parser.add_argument("--blender", default="blender")
    parser.add_argument("--scene", action="append", choices=SCENES, help="may be repeated")
    parser.add_argument("--size", default="96x72")
    parser.add_argument("--spp", type=int, default=128, help="of brume")
    parser.add_argument("--blender-spp", type=int, default=64)
    parser.add_argument("--reference", type=int, default=8, help="reference: so many times the spp")
    parser.add_argument("--rounds", type=int, default=4)
    parser.add_argument("--step-rate", type=float, default=1.0, help="Cycles: step in voxels")
    parser.add_argument("--volume-sampling", default="MULTIPLE_IMPORTANCE",
                        choices=["DISTANCE", "EQUIANGULAR", "MULTIPLE_IMPORTANCE"])
    parser.add_argument("--sky-sampling", default="AUTOMATIC", choices=["NONE", "AUTOMATIC"])
    parser.add_argument("--out", help="write OUT.md")
    options = parser.parse_args()
    if not shutil.which(options.blender):
        raise SystemExit(f"{options.blender}: not found; apt-get install --no-install-recommends "
                         "blender")

    lines = ["| scene | renderer | samples | CPU s | us a sample | relative RMSE | brume is better by |",
             "|---|---|--:|--:|--:|--:|--:|"]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for scene in options.scene or SCENES:
            if not SCENES[scene]["file"].exists():
                print(f"skipped: {scene} ({SCENES[scene]['file']} is not there)")
                continue
            job = {**COMMON, **SCENES[scene], "file": str(SCENES[scene]["file"]),
                   "size": [*map(int, options.size.split("x"))]}
            ours, theirs = (Measured(renderer(options, folder), job, spp, options.reference * spp,
                                     folder)
                            for renderer, spp in ((Brume, options.spp),
                                                  (Cycles, options.blender_spp)))
            for measured in (ours, theirs):
                measured.make_reference()
            for seed in range(options.rounds):
                for measured in (ours, theirs):
                    measured.add(options.brume, seed)
            print(f"{scene}: {agreement(options.brume, folder, ours, theirs)}", flush=True)
            ratio = ours.efficiency() / theirs.efficiency()
            lines += [ours.row(scene) + f"{ratio:.1f} |", theirs.row(scene) + "|"]
            print("\n".join(lines[-2:]), flush=True)
    print(f"{platform.machine()}, {os.cpu_count()} processors")
    if options.out:
        pathlib.Path(options.out + ".md").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
