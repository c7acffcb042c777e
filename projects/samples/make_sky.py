#!/usr/bin/env python3
"""Makes sky.hdr of the samples that have an environment map: a clear sky with a low sun behind haze.

Equirectangular as in docs/conventions.md: row 0 is +Y, columns begin at -X and pass -Z.
"""
import math
import pathlib

WIDTH, HEIGHT = 64, 32
SUN = (-0.62, 0.5, 0.6)  # direction, unit length but for rounding
HAZE = 20  # the larger, the narrower the sun's glow


def mixed(a, b, t):
    return [x + t * (y - x) for x, y in zip(a, b)]


def radiance(direction):
    height = direction[1]
    if height < 0:
        return mixed([0.5, 0.45, 0.4], [0.08, 0.07, 0.06], min(1, -6 * height))
    sky = mixed([1.0, 1.0, 0.95], [0.12, 0.32, 0.95], height**0.6)
    glow = math.exp(HAZE * (sum(a * b for a, b in zip(direction, SUN)) - 1))
    return [s + glow * sun for s, sun in zip(sky, [16, 10, 5])]


def rgbe(colour):
    largest = max(colour)
    mantissa, exponent = math.frexp(largest)
    scale = mantissa * 256 / largest
    return bytes([int(c * scale) for c in colour] + [exponent + 128])


def direction(column, row):
    azimuth = 2 * math.pi * (column + 0.5) / WIDTH
    polar = math.pi * (row + 0.5) / HEIGHT
    across = math.sin(polar)
    return (-across * math.cos(azimuth), math.cos(polar), -across * math.sin(azimuth))


def main():
    header = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {HEIGHT} +X {WIDTH}\n".encode()
    pixels = b"".join(rgbe(radiance(direction(x, y))) for y in range(HEIGHT) for x in range(WIDTH))
    for sample in ("ldm-fig1", "ldm-fig11"):
        folder = pathlib.Path(__file__).parent / f"{sample}.interreflect"
        (folder / "sky.hdr").write_bytes(header + pixels)


if __name__ == "__main__":
    main()
