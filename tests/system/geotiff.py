# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reads the GeoTIFFs that the program writes, without GDAL: a second opinion on their layout."""

import pathlib
import struct
import zlib

import numpy

WIDTH, HEIGHT, BITS, COMPRESSION, STRIPS, SAMPLES = 256, 257, 258, 259, 273, 277
ROWS_A_STRIP, STRIP_BYTES, PLANAR, PREDICTOR, SAMPLE_FORMAT = 278, 279, 284, 317, 339
PIXEL_SCALE, TIE_POINT, NO_DATA = 33550, 33922, 42113
TYPES = {1: "B", 2: "s", 3: "H", 4: "I", 12: "d", 16: "Q"}


class GeoTiff:
    """`values`: rows × columns × bands; `sample_format` 3 is IEEE float; the rest as tagged."""

    def __init__(self, path):
        self.data = pathlib.Path(path).read_bytes()
        if self.data[:4] != b"II*\0":
            raise ValueError(f"{path}: not a little-endian TIFF")
        self.tags = self._read_tags(struct.unpack_from("<I", self.data, 4)[0])
        self.bits = set(self.tags[BITS])
        self.sample_format = set(self.tags[SAMPLE_FORMAT])
        self.scale = self.tags.get(PIXEL_SCALE)
        self.tie_point = self.tags.get(TIE_POINT)
        self.values = self._read_values()

    def _read_tags(self, offset):
        tags = {}
        count = struct.unpack_from("<H", self.data, offset)[0]
        for i in range(count):
            entry = offset + 2 + 12 * i
            tag, kind, length = struct.unpack_from("<HHI", self.data, entry)
            if kind not in TYPES:
                continue
            layout = f"<{length}{TYPES[kind]}"
            place = entry + 8
            if struct.calcsize(layout) > 4:
                place = struct.unpack_from("<I", self.data, place)[0]
            tags[tag] = struct.unpack_from(layout, self.data, place)
        return tags

    def _read_values(self):
        """Deflated, predictor 3 (TIFF technical note 3): rows' differences in byte planes."""
        columns, rows = self.tags[WIDTH][0], self.tags[HEIGHT][0]
        bands = self.tags.get(SAMPLES, (1,))[0]
        if (self.tags[COMPRESSION][0], self.tags[PREDICTOR][0], self.bits) != (8, 3, {32}):
            raise ValueError("expected 32 bit floats, deflated with predictor 3")
        separate = self.tags.get(PLANAR, (1,))[0] == 2
        stride = 1 if separate else bands
        planes = []
        for start, size in zip(self.tags[STRIPS], self.tags[STRIP_BYTES]):
            raw = numpy.frombuffer(zlib.decompress(self.data[start:start + size]), numpy.uint8)
            differences = raw.reshape(-1, columns * 4, stride)
            summed = numpy.cumsum(differences, axis=1, dtype=numpy.uint8)
            ordered = summed.reshape(-1, 4, columns * stride)[:, ::-1, :].transpose(0, 2, 1)
            planes.append(numpy.ascontiguousarray(ordered).view("<f4").reshape(-1, columns, stride))
        values = numpy.concatenate(planes)
        if separate:
            values = values.reshape(bands, rows, columns).transpose(1, 2, 0)
        return values
