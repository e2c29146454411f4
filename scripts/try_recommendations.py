#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tries what a report of `brume trade` says.

    scripts/try_recommendations.py REPORT.json [--seconds 60] [--brume build/release/bin/brume]

At the size of the study and with seeds of its own it renders

- each recommendation that takes at most --seconds, and prints the promised and the found error; the
  ratio is wanted between 0.8 and 1.2;
- each biased setting for --seconds twice, and prints the interval of its bias and the bias found.

Noise is taken off: of independent pictures P and P' of a setting and Q and Q' of the default, the
mean of (P - Q)^2 over all four pairs, less half of (Q - Q')^2 is the squared error of P on average,
and less half of (P - P')^2, too, its squared bias.
"""

import argparse
import json
import math
import os
import shlex
import subprocess
import tempfile


class Scene:
    """Renders the scene of a report and compares the pictures."""

    def __init__(self, brume, report, folder):
        self.brume, self.folder = brume, folder
        size = f"{report['width']}x{report['height']}"
        self.command = [brume] + shlex.split(report["command"])[1:] + ["--size", size, "--quiet"]
        self.count = 0

    def render(self, options, spp):
        self.count += 1
        path = os.path.join(self.folder, f"{self.count}.exr")
        extra = ["--spp", str(spp), "--seed", str(1000 + self.count), "-o", path]
        subprocess.run(self.command + options + extra, check=True, stderr=subprocess.DEVNULL)
        return path

    def squared_difference(self, pictures, references):
        """Mean over the pairs, relative to the square of the mean radiance."""
        path = os.path.join(self.folder, "figures.json")
        squares = []
        for a in pictures:
            for b in references:
                subprocess.run([self.brume, "compare", a, b, "--json", path], check=True,
                               stdout=subprocess.DEVNULL)
                with open(path) as file:
                    squares.append(json.load(file)["relative_rmse"] ** 2)
        return sum(squares) / len(squares)


def samples_for(setting, seconds):
    return 16 * max(int(setting["spp"] * seconds / setting["seconds"] / 16), 1)


def try_recommendations(scene, report, seconds, references, noise):
    scale = report["full_width"] * report["full_height"] / (report["width"] * report["height"])
    for r in report["recommendations"]:
        if r["seconds_full_size"] / scale > seconds:
            continue
        picture = scene.render(r["options"], r["spp"])
        square = scene.squared_difference([picture], references) - noise
        error = math.sqrt(max(square, 0.0))
        print(f"{r['setting']:20} {r['spp']:7} spp  promised {100 * r['relative_rmse']:6.3g}%"
              f"  found {100 * error:6.3g}%  ratio {error / r['relative_rmse']:.2f}", flush=True)


def try_biases(scene, report, seconds, references, noise):
    for setting in report["settings"]:
        if not setting["biased"]:
            continue
        spp = samples_for(setting, seconds)
        pictures = [scene.render(setting["options"], spp) for _ in range(2)]
        own_noise = scene.squared_difference(pictures[:1], pictures[1:]) / 2
        square = scene.squared_difference(pictures, references) - noise - own_noise
        bias = setting["relative_squared_bias"]
        # As in the report: an estimate below 0 is 0 with bad luck.
        value = max(bias["value"], 0.0)
        low, high = (math.sqrt(max(value + sign * bias["interval_95"], 0.0))
                     for sign in (-1, 1))
        found = math.sqrt(max(square, 0.0))
        verdict = "inside" if low <= found <= high else "outside"
        print(f"{setting['setting']:20} bias {100 * low:6.3g}% to {100 * high:6.3g}%"
              f"  found {100 * found:6.3g}%  {verdict}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("report")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--brume", default="build/release/bin/brume")
    arguments = parser.parse_args()
    with open(arguments.report) as file:
        report = json.load(file)
    with tempfile.TemporaryDirectory() as folder:
        scene = Scene(arguments.brume, report, folder)
        spp = samples_for(report["settings"][0], 3 * arguments.seconds)
        references = [scene.render([], spp) for _ in range(2)]
        noise = scene.squared_difference(references[:1], references[1:]) / 2
        try_recommendations(scene, report, arguments.seconds, references, noise)
        try_biases(scene, report, arguments.seconds, references, noise)


if __name__ == "__main__":
    main()
