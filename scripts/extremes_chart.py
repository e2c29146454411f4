#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the chart of relative error against each extreme, and sums up the matrix in docs/extremes.md.

Arguments: the table that extremes_report wrote, the picture to draw, the page whose part between
the marks is replaced. A panel for each axis of the matrix with at least three extremes of known
radiance; of the channels, the one that is furthest off.
"""
import csv
import math
import sys
from collections import defaultdict
from xml.sax.saxutils import escape

LOW, HIGH = -8, 0  # decades of relative error shown
FAINTEST = 1e-37  # radiance below which floats lose digits
COLUMNS, WIDTH, HEIGHT = 4, 262, 170
LEFT, TOP, RIGHT, BOTTOM, LEGEND = 34, 26, 10, 24, 34
# Colours that readers with any colour vision tell apart (Okabe and Ito 2008).
DOT, BAR = "#d55e00", "#56b4e9"
BEGIN, END = "<!-- written by scripts/extremes.sh -->\n", "<!-- end -->\n"
LIMIT = 4.5  # standard errors that the test allows


class Row:
    def __init__(self, fields):
        self.axis, self.name, self.known = fields["axis"], fields["name"], fields["known"]
        for key in ("at", "want", "mean", "standard_error", "samples", "bad", "violations"):
            setattr(self, key, float(fields[key]))

    def has_error(self):
        return self.known != "soundness" and self.want > FAINTEST

    def error(self):
        return abs(self.mean - self.want) / self.want

    def spread(self):
        return self.standard_error / self.want


def rows_of(path):
    """The rows of each cell, one a channel."""
    cells = defaultdict(list)
    with open(path, newline="") as file:
        for fields in csv.DictReader(file):
            cells[fields["name"]].append(Row(fields))
    return list(cells.values())


def furthest(rows):
    """The channel furthest from what is known."""
    return max(rows, key=lambda r: r.error() if r.has_error() else -1)


def number(at):
    digits = 3 if abs(at) >= 1.5 or abs(at) < 0.5 else 7
    return f"{at:.{digits}g}".replace("e+0", "e").replace("e-0", "e-").replace("e+", "e")


def panel(axis, rows, x0, y0):
    inner_w, inner_h = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM
    places = sorted({r.at for r in rows})
    if places[0] <= 0:
        position = {at: i for i, at in enumerate(places)}
    else:
        position = {at: math.log10(at) for at in places}
    low, high = position[places[0]], position[places[-1]]

    def x(at):
        return x0 + LEFT + 8 + (position[at] - low) / (high - low) * (inner_w - 16)

    def y(error):
        decade = min(max(math.log10(error) if error > 0 else LOW, LOW), HIGH)
        return y0 + TOP + (HIGH - decade) / (HIGH - LOW) * inner_h

    out = [f'<text x="{x0 + LEFT}" y="{y0 + 16}" class="title">{escape(axis)}</text>']
    for decade in range(LOW, HIGH + 1, 2):
        level = y(10.0**decade)
        out.append(f'<line x1="{x0 + LEFT}" x2="{x0 + WIDTH - RIGHT}" y1="{level:.1f}" '
                   f'y2="{level:.1f}" class="grid"/>')
        out.append(f'<text x="{x0 + LEFT - 4}" y="{level + 3:.1f}" class="label" '
                   f'text-anchor="end">1e{decade}</text>')
    written = -math.inf
    for at in places:
        if x(at) - written < 34:
            continue
        written = x(at)
        out.append(f'<text x="{x(at):.1f}" y="{y0 + HEIGHT - BOTTOM + 13}" class="label" '
                   f'text-anchor="middle">{number(at)}</text>')
    for row in rows:
        if row.spread() > 0:
            top, bottom = y(LIMIT * row.spread()), y(0)
            out.append(f'<rect x="{x(row.at) - 2.5:.1f}" y="{top:.1f}" width="5" '
                       f'height="{bottom - top:.1f}" class="bar"/>')
    for row in rows:
        fill = DOT if row.known == "value" else "#fff"
        out.append(f'<circle cx="{x(row.at):.1f}" cy="{y(row.error()):.1f}" r="2.6" fill="{fill}" '
                   'class="dot"/>')
    return out


def draw(cells, path):
    axes = defaultdict(list)
    for row in cells:
        if row.has_error():
            axes[row.axis].append(row)
    panels = [(axis, rows) for axis, rows in axes.items() if len({r.at for r in rows}) >= 3]
    width, height = COLUMNS * WIDTH, LEGEND + math.ceil(len(panels) / COLUMNS) * HEIGHT
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
           f'viewBox="0 0 {width} {height}">',
           "<style>text{font-family:sans-serif;fill:#222;font-size:10px}.title{font-weight:bold}"
           f".label{{font-size:8px}}.grid{{stroke:#ddd}}.bar{{fill:{BAR}}}"
           f".dot{{stroke:{DOT}}}</style>",
           f'<rect width="{width}" height="{height}" fill="#fff"/>',
           f'<circle cx="{LEFT}" cy="16" r="2.6" fill="{DOT}" class="dot"/>',
           f'<text x="{LEFT + 8}" y="20">relative error against the known value</text>',
           f'<circle cx="{LEFT + 230}" cy="16" r="2.6" fill="#fff" class="dot"/>',
           f'<text x="{LEFT + 238}" y="20">against a render of the same scene, not extreme</text>',
           f'<rect x="{LEFT + 500}" y="11" width="5" height="10" class="bar"/>',
           f'<text x="{LEFT + 510}" y="20">up to {LIMIT} standard errors, which the test allows; '
           'errors below 1e-8 stand at 1e-8</text>']
    for i, (axis, rows) in enumerate(panels):
        out += panel(axis, rows, i % COLUMNS * WIDTH, LEGEND + i // COLUMNS * HEIGHT)
    out.append("</svg>")
    with open(path, "w") as file:
        file.write("\n".join(out) + "\n")


def summary(cells):
    rows = [row for channels in cells for row in channels]
    first = [channels[0] for channels in cells]
    known = [r for r in rows if r.has_error()]
    z = [(r.mean - r.want) / r.standard_error for r in known if r.spread() > 1e-4]
    exact = max((r for r in known if r.spread() <= 1e-6), key=Row.error)
    return (f"| cells | {len(cells)}, of them {sum(r.has_error() for r in first)} with a known "
            "radiance |\n|---|---|\n"
            f"| samples | {sum(r.samples for r in first) / 1e6:.1f} million |\n"
            f"| samples that are NaN, infinite or negative | {sum(r.bad for r in first):.0f} |\n"
            f"| violated majorants | {sum(r.violations for r in first):.0f} |\n"
            f"| distance from the known, in standard errors, of {len(z)} channels with a standard "
            f"error above 1e-4 | mean square {sum(v * v for v in z) / len(z):.2f}, largest "
            f"{max(map(abs, z)):.2f} |\n"
            f"| largest relative error where nothing is random | {exact.error():.1e}: "
            f"{exact.axis}, at {number(exact.at)} |\n")


def main():
    table, picture, page = sys.argv[1:]
    cells = rows_of(table)
    draw([furthest(rows) for rows in cells], picture)
    with open(page) as file:
        text = file.read()
    before, rest = text.split(BEGIN, 1)
    after = rest.split(END, 1)[1]
    with open(page, "w") as file:
        file.write(before + BEGIN + "\n" + summary(cells) + "\n" + END + after)
    print(summary(cells), end="")


main()
