#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How the cost of a path grows with voxels, optical thickness, threads and lights, and memory and
loading time with voxels.

    scripts/scaling.py --out scaling                # writes scaling.md and scaling.svg

Seconds are CPU seconds of the process, less those of a render with one sample and no scattering,
which is loading; the least of several rounds counts, as whatever else the machine does only adds to
them. Needs nothing but Python's standard library.
"""
import argparse
import math
import os
import pathlib
import platform
import tempfile

from measure import ROOT, panel, run, svg, volume_noise

WIDTH, HEIGHT = 64, 48  # of the pictures [pixel]

LAMPS = """<scene version="3.0.0">
  <integrator type="volpath"/>
  <sensor type="perspective"><float name="fov" value="45"/>
    <transform name="to_world"><lookat origin="0, 0, -4" target="0, 0, 0" up="0, 1, 0"/></transform>
    <film type="hdrfilm"><rfilter type="box"/></film></sensor>
  {medium}
  {lamps}
</scene>"""
FOG = """<medium type="homogeneous"><float name="sigma_t" value="0.3"/>
    <float name="albedo" value="0.9"/></medium>"""
CLOUD = """<medium type="heterogeneous"><float name="scale" value="10"/>
    <float name="albedo" value="0.9"/><volume name="sigma_t" type="gridvolume">
    <string name="filename" value="{file}"/><boolean name="use_grid_bbox" value="true"/></volume>
    </medium>"""


def lamps(count):
    """Point lights spread through [-1, 1]^3 by an additive recurrence, of constant power in all."""
    steps = (0.8191725133961645, 0.6710436067037893, 0.5497004779019703)
    places = [[2.0 * ((i + 0.5) * step % 1.0) - 1.0 for step in steps] for i in range(count)]
    return "\n".join(
        f'<emitter type="point"><point name="position" x="{x:.5f}" y="{y:.5f}" z="{z:.5f}"/>'
        f'<rgb name="intensity" value="{10 / count:.7g}"/></emitter>' for x, y, z in places)


class Bench:
    def __init__(self, brume, folder, rounds):
        self.brume, self.folder, self.rounds = brume, folder, rounds

    def micro(self, arguments, spp, settings=()):
        """CPU microseconds a path, and statistics and peak memory [MB] of the last render."""
        arguments = [*arguments, "--size", f"{WIDTH}x{HEIGHT}"]
        least = math.inf
        for seed in range(self.rounds):
            loading, _, _ = run(self.brume, [*arguments, "--max-depth", "1"], self.folder, 1, seed,
                                settings)
            seconds, statistics, memory = run(self.brume, arguments, self.folder, spp, seed,
                                              settings)
            least = min(least, max(seconds - loading, 1e-3))
        return 1e6 * least / (WIDTH * HEIGHT * spp), statistics, memory

    def volume(self, n):
        path = self.folder / f"noise{n}.vol"
        if not path.exists():
            volume_noise(path, n)
        return path


def say(lines, *cells):
    lines.append("| " + " | ".join(cells) + " |")
    print(lines[-1], flush=True)


def voxels(bench, sizes, lines):
    say(lines, "voxels a side", "us a path", "loading [s]", "peak memory [MB]",
        "over the voxels in float")
    say(lines, *["--:"] * 5)
    empty = bench.micro([bench.volume(8)], 2)[2]
    curve = []
    for n in sizes:
        path = bench.volume(n)
        micro, statistics, memory = bench.micro(
            [path, "--albedo", "0.995", "--g", "0.8", "--density-scale", "60"], 64)
        size = 4.0 * n**3 / 2**20
        say(lines, f"{n}", f"{micro:.2f}", f"{statistics['load_seconds']:.2f}", f"{memory:.0f}",
            f"{(memory - empty) / size:.2f}")
        curve.append((n, micro))
        if n > 256:
            path.unlink()  # gigabytes
    return {"": curve}


def thickness(bench, lines):
    """Through the middle of the ball; its density times its diameter is 2.66."""
    say(lines, "optical thickness", "us a path, albedo 0.9", "albedo 0.999", "textbook, 0.999")
    say(lines, *["--:"] * 4)
    series = {"albedo 0.9": [], "albedo 0.999": [], "textbook, 0.999": []}
    for tau in (1, 3, 10, 30, 100, 300, 1000):
        for (name, curve), albedo, spp, settings in zip(
                series.items(), (0.9, 0.999, 0.999), (256, 128, 256 if tau <= 30 else 16),
                ((), (), ("textbook",))):
            curve.append((tau, bench.micro(
                [bench.volume(128), "--albedo", albedo, "--g", 0.85, "--density-scale", tau / 2.66],
                spp, settings)[0]))
        say(lines, f"{tau}", *[f"{curve[-1][1]:.2f}" for curve in series.values()])
    return series


def threads(bench, lines):
    say(lines, "threads", "CPU us a path", "seconds by the clock")
    say(lines, *["--:"] * 3)
    series = {"CPU time": [], "clock": []}
    for n in (1, 2):
        if n > os.cpu_count():
            continue
        arguments = [ROOT / "media/cloud.vdb", "--threads", n]
        clock = math.inf
        for _ in range(bench.rounds):
            micro, statistics, _ = bench.micro(arguments, 256)
            clock = min(clock, statistics["render_seconds"])
        series["CPU time"].append((n, micro))
        series["clock"].append((n, 1e6 * clock / (WIDTH * HEIGHT * 256)))
        say(lines, f"{n}", f"{micro:.2f}", f"{clock:.2f}")
    return series


def lights(bench, lines):
    say(lines, "lamps", "us a path in fog", "in a cloud")
    say(lines, *["--:"] * 3)
    series = {"homogeneous fog": [], "cloud": []}
    cloud = CLOUD.format(file=bench.volume(64))
    for n in (1, 3, 10, 30, 100, 300, 1000):
        for curve, medium in zip(series.values(), (FOG, cloud)):
            scene = bench.folder / "lamps.xml"
            scene.write_text(LAMPS.format(medium=medium, lamps=lamps(n)))
            curve.append((n, bench.micro([scene], 64 if n <= 100 else 16)[0]))
        say(lines, f"{n}", *[f"{curve[-1][1]:.2f}" for curve in series.values()])
    return series


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--brume", default=str(ROOT / "build/release/bin/brume"))
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--voxels", type=int, default=1024,
                        help="largest grid, voxels a side; 1024 takes minutes and 10 GB")
    parser.add_argument("--out", help="write OUT.md and OUT.svg")
    options = parser.parse_args()

    sizes = [n for n in (64, 128, 256, 512, 1024) if n <= options.voxels]
    lines, parts = [], []
    width, height = 460, 290
    with tempfile.TemporaryDirectory() as name:
        bench = Bench(options.brume, pathlib.Path(name), options.rounds)
        for i, (title, x_label, curves) in enumerate((
                ("voxels", "voxels a side", lambda: voxels(bench, sizes, lines)),
                ("optical thickness", "through the middle", lambda: thickness(bench, lines)),
                ("threads", "threads", lambda: threads(bench, lines)),
                ("lights", "point lights", lambda: lights(bench, lines)))):
            parts += panel(title, x_label, "us a path", curves(), i % 2 * width, i // 2 * height,
                           width, height)
            lines.append("")
    print(f"{platform.machine()}, {os.cpu_count()} processors")
    if options.out:
        pathlib.Path(options.out + ".md").write_text("\n".join(lines))
        pathlib.Path(options.out + ".svg").write_text(svg(2 * width, 2 * height, parts))


if __name__ == "__main__":
    main()
