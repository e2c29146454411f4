#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws docs/extremes.svg from docs/extremes.csv: relative error against each extreme.

A panel for each axis of the matrix with at least three extremes of known radiance. Dots are
|mean - want| / want, open where the expected radiance is that of another render; the bar reaches up
to 4.5 standard errors, the limit that the test allows. Prints a summary of the whole matrix.
"""
import csv
import math
import sys
from collections import defaultdict
from xml.sax.saxutils import escape

LOW, HIGH = -8, 0  # decades of relative error shown
COLUMNS, WIDTH, HEIGHT = 4, 250, 170
LEFT, TOP, RIGHT, BOTTOM = 34, 26, 8, 24


def read(path):
    axes = defaultdict(list)
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            if row["channel"] == "g":
                axes[row["axis"]].append(
                    {k: float(row[k]) for k in ("at", "want", "mean", "standard_error", "samples",
                                                "bad", "violations", "seconds")})
    return axes


def relative(row):
    want = row["want"]
    if not want > 1e-37:
        return None
    return abs(row["mean"] - want) / want, row["standard_error"] / want


def panel(axis, rows, column, line):
    x0, y0 = column * WIDTH, line * HEIGHT
    inner_w, inner_h = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM
    signed = min(r["at"] for r in rows) < 0 or any(r["at"] == 0 for r in rows)
    places = sorted({r["at"] for r in rows})
    if signed:
        position = {at: i for i, at in enumerate(places)}
        low, high = 0, max(1, len(places) - 1)
    else:
        position = {at: math.log10(at) for at in places}
        low, high = position[places[0]], position[places[-1]]

    def x(at):
        return x0 + LEFT + 6 + (position[at] - low) / (high - low) * (inner_w - 12)

    def y(error):
        decade = min(max(math.log10(error) if error > 0 else LOW, LOW), HIGH)
        return y0 + TOP + (HIGH - decade) / (HIGH - LOW) * inner_h

    out = [f'<text x="{x0 + LEFT}" y="{y0 + 16}" class="title">{escape(axis)}</text>']
    for decade in range(LOW, HIGH + 1, 2):
        level = y(10.0 ** decade)
        out.append(f'<line x1="{x0 + LEFT}" x2="{x0 + WIDTH - RIGHT}" y1="{level:.1f}" '
                   f'y2="{level:.1f}" class="grid"/>')
        out.append(f'<text x="{x0 + LEFT - 4}" y="{level + 3:.1f}" class="label" '
                   f'text-anchor="end">1e{decade}</text>')
    step = max(1, math.ceil(len(places) / 6))
    for at in places[::step]:
        out.append(f'<text x="{x(at):.1f}" y="{y0 + HEIGHT - BOTTOM + 13}" class="label" '
                   f'text-anchor="middle">{at:.4g}</text>')
    for row in rows:
        error, spread = relative(row)
        if spread > 0:
            out.append(f'<line x1="{x(row["at"]):.1f}" x2="{x(row["at"]):.1f}" '
                       f'y1="{y(4.5 * spread):.1f}" y2="{y(10.0 ** LOW):.1f}" class="bar"/>')
        out.append(f'<circle cx="{x(row["at"]):.1f}" cy="{y(error):.1f}" r="2.6" class="dot"/>')
    return out


def main():
    axes = read(sys.argv[1])
    panels = []
    for axis, rows in axes.items():
        known = [r for r in rows if relative(r) is not None]
        if len({r["at"] for r in known}) >= 3:
            panels.append((axis, known))
    lines = math.ceil(len(panels) / COLUMNS)
    width, height = COLUMNS * WIDTH, lines * HEIGHT
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
           f'viewBox="0 0 {width} {height}">',
           "<style>text{font-family:sans-serif;fill:#222}.title{font-size:10px;font-weight:bold}"
           ".label{font-size:8px}.grid{stroke:#ddd}.bar{stroke:#9cf;stroke-width:5}"
           ".dot{fill:#c30}</style>",
           f'<rect width="{width}" height="{height}" fill="#fff"/>']
    for i, (axis, rows) in enumerate(panels):
        out += panel(axis, rows, i % COLUMNS, i // COLUMNS)
    out.append("</svg>")
    with open(sys.argv[2], "w") as file:
        file.write("\n".join(out) + "\n")

    rows = [r for rows in axes.values() for r in rows]
    z = [(r["mean"] - r["want"]) / r["standard_error"] for r in rows
         if relative(r) is not None and r["standard_error"] > 1e-4 * r["want"]]
    print(f"{len(rows)} cells, {sum(r['samples'] for r in rows):.3g} samples, "
          f"{sum(r['bad'] for r in rows):.0f} bad samples, "
          f"{sum(r['violations'] for r in rows):.0f} violated majorants, "
          f"{sum(r['seconds'] for r in rows):.0f} s; of {len(z)} with a standard error above 1e-4 "
          f"the mean square of z is {sum(v * v for v in z) / len(z):.2f}, "
          f"the largest |z| {max(abs(v) for v in z):.2f}")


main()
