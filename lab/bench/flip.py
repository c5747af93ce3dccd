#!/usr/bin/env python3
"""FLIP (Andersson et al. 2020) of pictures against one reference, by the package flip-evaluator. Prints one number for each picture.

    flip.py REFERENCE.png MASK.png PICTURE.png...

The pictures are tone-mapped already (docs/conventions.md). The mean is over the pixels where the mask is white. 0.7 metres from a
monitor 0.7 metres wide with 3840 pixels across, FLIP's own default.
"""

import sys

try:
    import flip_evaluator
    import numpy
    from matplotlib.image import imread
except ImportError as reason:
    print(reason, file=sys.stderr)
    sys.exit(3)


def picture(path):
    return numpy.ascontiguousarray(imread(path)[..., :3], dtype=numpy.float32)


def main(arguments):
    if len(arguments) < 3:
        print(__doc__, file=sys.stderr)
        return 2
    reference = picture(arguments[0])
    mask = picture(arguments[1])[..., 0] > 0.5
    for path in arguments[2:]:
        error_map, _, _ = flip_evaluator.evaluate(reference, picture(path), "LDR", applyMagma=False)
        print(f"{float(error_map[..., 0][mask].mean()):.6f}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
