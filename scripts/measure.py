# SPDX-License-Identifier: Apache-2.0
"""What the measuring scripts share: running brume, making a large volume, drawing charts."""
import json
import math
import os
import pathlib
import struct
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
SAMPLES = ROOT / "../shared/media-samples/vdb"

# Colours that readers with any colour vision tell apart (Okabe and Ito 2008).
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7"]


def run(brume, arguments, folder, spp, seed, settings=()):
    """User seconds, statistics and peak memory [MB] of one render."""
    command = [brume, "render", *map(str, arguments), "--spp", str(spp), "--seed", str(seed),
               "--quiet", "-o", str(folder / "picture.exr"), "--json", str(folder / "picture.json")]
    for setting in settings:
        command += ["--set", setting]
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        raise SystemExit(f"failed: {' '.join(command)}")
    statistics = json.loads((folder / "picture.json").read_text())
    return usage.ru_utime, statistics, usage.ru_maxrss / 1024.0


def volume_noise(path, n):
    """A .vol file of n^3 voxels: a ball of sines of mixed frequencies, cut off below zero."""
    axis = [2.0 * (i + 0.5) / n - 1.0 for i in range(n)]
    waves = [[sum(math.sin(f * k * x + s) / k for k in (3, 7, 17, 41)) for x in axis]
             for f, s in ((1.0, 0.3), (1.1, 1.7), (0.9, 4.1))]
    with open(path, "wb") as file:
        file.write(b"VOL" + struct.pack("<B5i6f", 3, 1, n, n, n, 1, -1, -1, -1, 1, 1, 1))
        row = struct.Struct(f"<{n}f")
        wx, ball_x = waves[0], [x * x for x in axis]
        for z in range(n):
            for y in range(n):
                wyz = waves[1][y] * waves[2][z]
                edge = 1.0 - axis[y] ** 2 - axis[z] ** 2
                if edge <= 0.0:
                    file.write(bytes(4 * n))
                    continue
                file.write(row.pack(*[max(0.0, 2.0 * (edge - b) + 0.8 * w * wyz) if b < edge
                                      else 0.0 for b, w in zip(ball_x, wx)]))


def svg(width, height, parts):
    return "\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" '
                      f'height="{height:.0f}" font-family="sans-serif" font-size="13">',
                      f'<rect width="{width:.0f}" height="{height:.0f}" fill="#fff"/>', *parts,
                      "</svg>", ""])


def bars(title, rows):
    """Bars of (name, ratio) on a logarithmic axis with a line at 1."""
    height, left, unit = 26, 190, 130
    top = max(2.0, max(ratio for _, ratio in rows))
    parts = [f'<text x="{left}" y="16">{title}</text>']
    for i, (name, ratio) in enumerate(rows):
        y = 28 + height * i
        bar = max(unit * (math.log10(max(ratio, 0.5)) + 0.3), 1.0)
        parts.append(f'<text x="{left - 8}" y="{y + 14}" text-anchor="end">{name}</text>'
                     f'<rect x="{left}" y="{y}" width="{bar:.1f}" height="18" '
                     f'fill="{COLOURS[0]}"/>'
                     f'<text x="{left + bar + 6:.1f}" y="{y + 14}">{ratio:.1f}</text>')
    x = left + 0.3 * unit
    parts.append(f'<line x1="{x}" y1="22" x2="{x}" y2="{28 + height * len(rows)}" stroke="#888"/>')
    return svg(left + unit * (math.log10(top) + 0.3) + 90, height * len(rows) + 40, parts)


def short(value):
    return f"{value:g}" if value < 1e6 else f"{value:.0e}".replace("e+0", "e")


def panel(title, x_label, y_label, series, x0, y0, width, height):
    """Curves on two logarithmic axes; `series` maps a name to a list of (x, y), both positive."""
    left, right, top, bottom = 58, 14, 26, 46
    points = [p for curve in series.values() for p in curve]
    x_low, x_high = (f(math.log10(x) for x, _ in points) for f in (min, max))
    y_low = math.floor(min(math.log10(y) for _, y in points))
    y_high = max(y_low + 1, math.ceil(max(math.log10(y) for _, y in points)))

    def place(x, y):
        across = (math.log10(x) - x_low) / max(x_high - x_low, 1e-9)
        up = (math.log10(y) - y_low) / (y_high - y_low)
        return (x0 + left + across * (width - left - right),
                y0 + height - bottom - up * (height - top - bottom))

    parts = [f'<text x="{x0 + left}" y="{y0 + 16}" font-weight="bold">{title}</text>']
    for decade in range(y_low, y_high + 1):
        x, y = place(10**x_low, 10**decade)
        parts.append(f'<line x1="{x:.1f}" y1="{y:.1f}" x2="{x0 + width - right}" y2="{y:.1f}" '
                     f'stroke="#ddd"/><text x="{x - 6:.1f}" y="{y + 4:.1f}" text-anchor="end">'
                     f'{short(10.0**decade)}</text>')
    for x in sorted({p[0] for p in points}):
        at, y = place(x, 10**y_low)
        parts.append(f'<text x="{at:.1f}" y="{y + 16:.1f}" text-anchor="middle">{short(x)}</text>')
    parts.append(f'<text x="{x0 + (left + width - right) / 2}" y="{y0 + height - 10}" '
                 f'text-anchor="middle">{x_label}</text>'
                 f'<text transform="translate({x0 + 14},{y0 + (height - bottom + top) / 2}) '
                 f'rotate(-90)" text-anchor="middle">{y_label}</text>')
    for i, (name, curve) in enumerate(series.items()):
        colour = COLOURS[i]
        places = [place(*p) for p in curve]
        line = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
        parts.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2"/>')
        parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>' for x, y in places]
        if len(series) > 1:
            parts.append(f'<text x="{x0 + left + 8}" y="{y0 + top + 14 + 16 * i}" '
                         f'fill="{colour}">{name}</text>')
    return parts
