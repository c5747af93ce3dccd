#!/usr/bin/env python3
"""Light that layered tissue gives back, by Mitsuba 3's volumetric path tracer: a second opinion on lab/reference/tissue.

    pip install mitsuba==3.9.1 numpy
    mitsuba_check.py [--samples N] [--variant scalar_rgb]

A camera looks straight down through a parallel beam of rays on flat tissue under a white sky. By reciprocity each pixel then holds the share of a
perpendicular beam that leaves again, reflection at the surface included.
"""
import argparse
import math
import time

import numpy as np

CENTIMETRE = 0.1  # coefficients in 1/cm, as 1/mm
EPIDERMIS = dict(absorption=(2.1, 2.1, 5.0), scattering=(48, 60, 65), index=1.4, unit=CENTIMETRE)
UPPER_DERMIS = dict(absorption=(0.16, 0.19, 0.30), scattering=(32, 40, 46), index=1.34, unit=CENTIMETRE)
BLOODY_DERMIS = dict(absorption=(0.085, 1.0, 25), scattering=(4.5, 4.7, 4.8), index=1.4, unit=CENTIMETRE)
JENSEN_SKIN = dict(absorption=(0.032, 0.17, 0.48), scattering=(0.74, 0.88, 1.01), index=1.4, unit=1)

HALF_WIDTH = 400  # mm: nothing comes back from the sides
BOTTOM = 150  # mm: nothing comes back from below either


def medium(substance):
    absorption = np.array(substance["absorption"]) * substance["unit"]
    scattering = np.array(substance["scattering"]) * substance["unit"]
    extinction = absorption + scattering
    rgb = lambda values: {"type": "rgb", "value": [float(v) for v in values]}
    return {
        "type": "homogeneous",
        "albedo": rgb(scattering / extinction),
        "sigma_t": rgb(extinction / extinction.max()),  # a colour: at most 1
        "scale": float(extinction.max()),
        "phase": {"type": "isotropic"},
    }


def scene(mi, layers, endless, side, samples):
    """Layers: (substance, thickness in mm) from the top; the last one has no lower surface when endless.

    volpathmis: the plain volpath draws free paths for one channel and weighs the others by ratios that hardly ever, but then greatly, exceed 1; after
    hundreds of collisions its mean lies below the truth in every run of reasonable length.
    """
    T = mi.ScalarTransform4f
    result = {
        "type": "scene",
        "integrator": {"type": "volpathmis", "max_depth": -1, "rr_depth": 10000},
        "sky": {"type": "constant"},
        "camera": {
            "type": "orthographic",
            "to_world": T().look_at(origin=[0, 0, 10], target=[0, 0, 0], up=[0, 1, 0]),
            "film": {"type": "hdrfilm", "width": side, "height": side, "rfilter": {"type": "box"}},
            "sampler": {"type": "independent", "sample_count": samples},
        },
    }
    for i, (substance, _) in enumerate(layers):
        result[f"medium{i}"] = medium(substance)
    depth = 0.0
    for i in range(len(layers) + (0 if endless else 1)):
        above = layers[i - 1][0]["index"] if i > 0 else 1.0
        below = layers[i][0]["index"] if i < len(layers) else 1.0
        surface = {
            "type": "rectangle",  # faces up
            "to_world": T().translate([0, 0, -depth]).scale([HALF_WIDTH, HALF_WIDTH, 1]),
            "bsdf": {"type": "dielectric", "int_ior": below, "ext_ior": above},
        }
        if i < len(layers):
            surface["interior"] = {"type": "ref", "id": f"medium{i}"}
            depth += layers[i][1]
        if i > 0:
            surface["exterior"] = {"type": "ref", "id": f"medium{i - 1}"}
        result[f"surface{i}"] = surface
    if endless:
        result["floor"] = {
            "type": "rectangle",
            "to_world": T().translate([0, 0, -BOTTOM]).scale([HALF_WIDTH, HALF_WIDTH, 1]),
            "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0}},
            "exterior": {"type": "ref", "id": f"medium{len(layers) - 1}"},
        }
    return mi.load_dict(result)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--samples", type=int, default=262144, help="paths for each tissue")
    parser.add_argument("--variant", default="scalar_rgb")
    options = parser.parse_args()
    import mitsuba as mi

    mi.set_variant(options.variant)
    side = 32
    per_pixel = max(1, options.samples // side**2)
    tissues = {
        "skin1 of Jensen et al., endless": ([(JENSEN_SKIN, math.inf)], True),
        "epidermis alone, 0.25 mm, both sides": ([(EPIDERMIS, 0.25)], False),
        "three layers": ([(EPIDERMIS, 0.25), (UPPER_DERMIS, 0.20), (BLOODY_DERMIS, math.inf)], True),
    }
    print(f"Mitsuba {mi.__version__}, {options.variant}, {side * side * per_pixel} paths\n")
    print("| tissue | light that leaves, R / G / B | standard error | seconds |\n|---|---|---|---|")
    for name, (layers, endless) in tissues.items():
        start = time.time()
        pixels = np.array(mi.render(scene(mi, layers, endless, side, per_pixel), seed=1)).reshape(-1, 3)
        mean = pixels.mean(axis=0)
        error = pixels.std(axis=0, ddof=1) / math.sqrt(len(pixels))
        row = lambda values: " / ".join(f"{v:.4f}" for v in values)
        print(f"| {name} | {row(mean)} | {row(error)} | {time.time() - start:.0f} |", flush=True)


if __name__ == "__main__":
    main()
