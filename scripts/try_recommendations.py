#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tries what a report of `brume trade` recommends and says how large the error really is.

    scripts/try_recommendations.py REPORT.json [--seconds 60] [--brume build/release/bin/brume]

Renders each recommendation that takes at most --seconds at the size of the study, with a seed of
its own, and measures it against two long renders of the default settings. Their noise is taken off:
of a picture P and independent references Q and R, mean((P - Q)^2) - mean((Q - R)^2) / 2 is the
squared error of P on average. Prints one line a recommendation: promised and found error, and the
ratio, which is wanted between 0.8 and 1.2.
"""

import argparse
import json
import math
import os
import shlex
import subprocess
import tempfile


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("report")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--brume", default="build/release/bin/brume")
    arguments = parser.parse_args()
    with open(arguments.report) as file:
        report = json.load(file)
    scale = report["full_width"] * report["full_height"] / (report["width"] * report["height"])
    size = f"{report['width']}x{report['height']}"
    command = [arguments.brume] + shlex.split(report["command"])[1:] + ["--size", size, "--quiet"]

    with tempfile.TemporaryDirectory() as folder:

        def render(name, options, spp, seed):
            path = os.path.join(folder, name)
            extra = ["--spp", str(spp), "--seed", str(seed), "-o", path]
            subprocess.run(command + options + extra, check=True, stderr=subprocess.DEVNULL)
            return path

        def rmse(a, b):
            path = os.path.join(folder, "figures.json")
            subprocess.run([arguments.brume, "compare", a, b, "--json", path], check=True,
                           stdout=subprocess.DEVNULL)
            with open(path) as file:
                return json.load(file)["relative_rmse"]

        tried = [r for r in report["recommendations"]
                 if r["seconds_full_size"] / scale <= arguments.seconds]
        if not tried:
            print("nothing takes so little time")
            return
        # Noise of the references as small as that of the best picture that is tried.
        default = report["settings"][0]
        finest = min(r["relative_rmse"] for r in tried)
        variance = default["relative_squared_error"]["value"]
        spp = 16 * math.ceil(default["spp"] * variance / finest**2 / 16)
        references = [render(f"reference{i}.exr", [], spp, 1000 + i) for i in (1, 2)]
        noise = rmse(*references) ** 2 / 2
        for r in tried:
            picture = render("picture.exr", r["options"], r["spp"], 2000)
            squares = [rmse(picture, reference) ** 2 for reference in references]
            error = math.sqrt(max(sum(squares) / 2 - noise, 0.0))
            print(f"{r['setting']:24} {r['spp']:8} spp  promised {100 * r['relative_rmse']:6.3g}%"
                  f"  found {100 * error:6.3g}%  ratio {error / r['relative_rmse']:.2f}", flush=True)


if __name__ == "__main__":
    main()
