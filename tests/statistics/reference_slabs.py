#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reflectance and transmittance of slabs, by adding-doubling: prints slab_table.h.

The equation of transfer of a homogeneous slab, averaged over azimuth, is discretised in the cosine
mu by Gauss-Legendre quadrature on each hemisphere. A thin layer is solved exactly by a matrix
exponential and doubled until it is the slab (van de Hulst 1980, ch. 4). The Henyey-Greenstein peak
beyond the order of the quadrature counts as unscattered (delta-M, Wiscombe 1977). By reciprocity a
view at mu into a slab lit uniformly from one side shows the plane albedo R(mu), or T(mu) from the
other side; mu = 1 is an observer of weight 0. It shares no code or method with brume. Its digits
do not change with more nodes: up to g = 0.75 with 36 or 48, at 0.95 in the sixth digit.

Usage: reference_slabs.py > slab_table.h    takes some minutes
"""
import math
from operator import mul

ALBEDOS = (0.2, 0.5, 0.9, 1.0)
TAUS = (0.1, 0.5, 2.0, 8.0, 32.0, 64.0)
GS = (-0.8, 0.0, 0.5, 0.75, 0.95)


def legendre(order, x):
    """P_0 .. P_order at x."""
    p = [1.0, x]
    for n in range(1, order):
        p.append(((2 * n + 1) * x * p[n] - n * p[n - 1]) / (n + 1))
    return p[: order + 1]


def gauss(n):
    """Nodes and weights on [0, 1]."""
    nodes, weights = [], []
    for i in range(n):
        x = math.cos(math.pi * (i + 0.75) / (n + 0.5))
        for _ in range(50):
            p = legendre(n, x)
            slope = n * (x * p[n] - p[n - 1]) / (x * x - 1.0)
            step = p[n] / slope
            x -= step
            if abs(step) < 1e-16:
                break
        nodes.append(0.5 + 0.5 * x)
        weights.append(1.0 / ((1.0 - x * x) * slope * slope))
    return nodes, weights


def product(a, b):
    columns = list(zip(*b))
    return [[sum(map(mul, row, column)) for column in columns] for row in a]


def combined(a, b, factor=1.0):
    return [[x + factor * y for x, y in zip(r, s)] for r, s in zip(a, b)]


def identity(n):
    return [[float(i == j) for j in range(n)] for i in range(n)]


def solved(a, b):
    """X with a X = b, by elimination with pivoting."""
    n = len(a)
    rows = [list(r) + list(s) for r, s in zip(a, b)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        inverse = 1.0 / rows[k][k]
        rows[k] = top = [x * inverse for x in rows[k]]
        for i in range(n):
            if i != k and rows[i][k] != 0.0:
                f = rows[i][k]
                rows[i] = [x - f * y for x, y in zip(rows[i], top)]
    return [r[n:] for r in rows]


def thin_layer(generator, d):
    """R and T of a layer of optical thickness d, exactly, from the exponential of its generator."""
    n = len(generator) // 2
    a = [[d * x for x in row] for row in generator]
    power = total = identity(2 * n)
    for k in range(1, 40):
        power = [[x / k for x in row] for row in product(power, a)]
        total = combined(total, power)
        if max(max(map(abs, row)) for row in power) < 1e-18:
            break
    e11, e12 = [r[:n] for r in total[:n]], [r[n:] for r in total[:n]]
    e21, e22 = [r[:n] for r in total[n:]], [r[n:] for r in total[n:]]
    reflection = [[-x for x in row] for row in solved(e22, e21)]
    return reflection, combined(e11, product(e12, reflection))


def slab_family(g, albedo, taus, nodes):
    """(tau, R(1), T(1), diffuse R, diffuse T) for taus."""
    mu, weight = gauss(nodes)
    mu.append(1.0)
    weight.append(0.0)
    n = len(mu)
    order = 2 * nodes
    peak = g**order  # delta-M
    moments = [(2 * l + 1) * (g**l - peak) / (1.0 - peak) for l in range(order)]
    scaled = albedo * (1.0 - peak) / (1.0 - albedo * peak)
    p = [legendre(order - 1, x) for x in mu]
    even = [[m * x if l % 2 == 0 else 0.0 for l, (m, x) in enumerate(zip(moments, q))] for q in p]
    odd = [[m * x if l % 2 == 1 else 0.0 for l, (m, x) in enumerate(zip(moments, q))] for q in p]
    s, t = product(even, list(zip(*p))), product(odd, list(zip(*p)))
    into = [0.5 * scaled * w for w in weight]
    forward = [[w * (x + y) for w, x, y in zip(into, a, b)] for a, b in zip(s, t)]
    backward = [[w * (x - y) for w, x, y in zip(into, a, b)] for a, b in zip(s, t)]
    generator = [
        [(forward[i][j] - (i == j)) / mu[i] for j in range(n)] + [x / mu[i] for x in backward[i]]
        for i in range(n)
    ] + [
        [-x / mu[i] for x in backward[i]] + [((i == j) - forward[i][j]) / mu[i] for j in range(n)]
        for i in range(n)
    ]

    results = []
    for tau in taus:
        thickness = tau * (1.0 - albedo * peak)
        doublings = max(0, math.ceil(math.log2(thickness / (0.5 * min(mu)))))
        r, t = thin_layer(generator, thickness / 2**doublings)
        for _ in range(doublings):
            # Light between two equal layers bounces any number of times: (1 - R R)^-1.
            bounced = solved(combined(identity(n), product(r, r), -1.0), t)  # (1 - R R)^-1 T
            through = product(t, bounced)
            r = combined(r, product(t, product(r, bounced)))
            t = through
        plane_r, plane_t = [sum(row) for row in r], [sum(row) for row in t]
        diffuse = [2.0 * m * w for m, w in zip(mu, weight)]
        results.append((tau, plane_r[-1], plane_t[-1],
                        sum(map(mul, diffuse, plane_r)), sum(map(mul, diffuse, plane_t))))
    return results


def main():
    print("""// SPDX-License-Identifier: Apache-2.0
// Printed by reference_slabs.py, by adding-doubling.
#pragma once

namespace brume::test {

/// Reflectance and transmittance (the unscattered light included) of a slab of optical thickness
/// `tau`, for a beam along its normal and for uniform light from one side.
struct SlabReference {
  double g, albedo, tau;
  double R_normal, T_normal, R_diffuse, T_diffuse;
};

// clang-format off
inline constexpr SlabReference kSlabs[] = {""")
    for g in GS:
        nodes = 48 if abs(g) < 0.9 else 80  # a hemisphere
        for albedo in ALBEDOS:
            for tau, *values in slab_family(g, albedo, TAUS, nodes):
                print(f"    {{{g:g}, {albedo:g}, {tau:g}, " +
                      ", ".join(f"{v:.7g}" for v in values) + "},", flush=True)
    print("""};
// clang-format on

}  // namespace brume::test""")


main()
