#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds the error that `brume render --error` claims against the error that its pictures have.

Renders each scene with many seeds for each target, compares the pictures with a reference, and
prints a table in Markdown: the share of pictures whose true relative RMSE lies below the claimed
bound, and quantiles of true error over bound. The reference's own error, which `brume compare` sees
as well, is subtracted in squares. Takes about an hour and a half of processor time.

    scripts/calibrate.py [--brume build/release/bin/brume] [--seeds 60] [--scene NAME]...
                         [--target E]...
"""

import argparse
import json
import math
import os
import subprocess
import tempfile

SCENES = {  # name: size; small, because what is tested does not depend on it, but light paths need 1300
    "smoke_plume_coloured_albedo": "24x18",
    "small_bright_cloud": "24x18",
    "cornell_box_spheres_area_lights_fog": "40x34",
    "cornell_box_spheres_god_rays": "40x34",
    "vdb_cloud_sun_sky": "12x9",
}
REFERENCE_PART = 0.2  # the reference's error, of the least target


def run(*command):
    subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL)


def load(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


class Scene:
    def __init__(self, brume, name, folder, least_target):
        self.brume, self.name, self.folder = brume, name, folder
        path = os.path.join(os.path.dirname(__file__), "..", "scenes", name + ".xml")
        self.words = [brume, "render", path, "--size", SCENES[name], "--quiet"]
        self.reference, claim = self.render(REFERENCE_PART * least_target, 1_000_000)
        self.reference_error = claim["relative_rms_error"]

    def render(self, target, seed):
        picture = os.path.join(self.folder, f"{self.name}_{seed}.exr")
        statistics = picture + ".json"
        run(*self.words, "--error", target, "--seed", seed, "-o", picture, "--json", statistics)
        return picture, load(statistics)

    def true_error_and_bound(self, target, seed):
        picture, claim = self.render(target, seed)
        result = picture + ".compare.json"
        run(self.brume, "compare", picture, self.reference, "--json", result)
        squared = load(result)["relative_rmse"] ** 2 - self.reference_error**2
        os.remove(picture)
        return math.sqrt(max(squared, 0.0)), claim["relative_rms_error_bound_95"]


def quantile(values, q):
    ordered = sorted(values)
    return ordered[min(int(q * len(ordered)), len(ordered) - 1)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--brume", default="build/release/bin/brume")
    parser.add_argument("--seeds", type=int, default=60)
    parser.add_argument("--scene", action="append", choices=SCENES)
    parser.add_argument("--target", action="append", type=float, help="0.05 and 0.02 if not given")
    arguments = parser.parse_args()
    targets = arguments.target or [0.05, 0.02]
    print("| scene | target | within the bound | true error over bound: median | 5% to 95% |")
    print("|---|---|---|---|---|")
    for name in arguments.scene or SCENES:
        with tempfile.TemporaryDirectory() as folder:
            scene = Scene(arguments.brume, name, folder, min(targets))
            for target in targets:
                runs = [scene.true_error_and_bound(target, seed)
                        for seed in range(arguments.seeds)]
                held = sum(true < bound for true, bound in runs)
                ratios = [true / bound for true, bound in runs]
                print(f"| {name} {SCENES[name]} | {100 * target:g}% | {held} of {len(runs)} "
                      f"| {quantile(ratios, 0.5):.2f} "
                      f"| {quantile(ratios, 0.05):.2f} to {quantile(ratios, 0.95):.2f} |",
                      flush=True)


if __name__ == "__main__":
    main()
