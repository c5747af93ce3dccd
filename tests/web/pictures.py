"""Pictures of a page held against Vulkan's."""

import io
import os
import pathlib

KEEP = os.environ.get("TEGUMENT_TEST_PICTURES")  # a folder for the pictures, to look at
STEPS = 4  # of 255: what is further apart than this is off


def png(data):
    from PIL import Image

    image = Image.open(io.BytesIO(data)).convert("RGB")
    return image.size, list(image.getdata())


def kept(name, data):
    if KEEP:
        pathlib.Path(KEEP, f"{name}.png").write_bytes(data)
    return png(data)


def apart(ours, theirs):
    """Relative L2 of the pictures as they are shown, and the share of pixels with a channel that is off."""
    squares = sum((a - b) ** 2 for one, other in zip(ours, theirs) for a, b in zip(one, other))
    whole = sum(b * b for other in theirs for b in other)
    off = sum(max(abs(a - b) for a, b in zip(one, other)) > STEPS for one, other in zip(ours, theirs))
    return (squares / whole) ** 0.5, off / len(ours)


def expect_alike(test, name, ours, theirs, most_apart, most_off):
    (size, ours), (expected, theirs) = ours, theirs
    test.assertEqual(size, expected)
    distance, off = apart(ours, theirs)
    print(f"{name}: relative L2 {distance:.4f}, {off:.2%} of the pixels more than {STEPS} of 255 off", flush=True)
    test.assertLess(distance, most_apart)
    test.assertLess(off, most_off)
