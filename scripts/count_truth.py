#!/usr/bin/env python3
"""Counts the light of scenes/truth: photons through analytic shapes in double precision, closed forms where there are any.

Shares no code with the engine, so that each can hold the other. It knows what these scenes have: one object of glass, water or
mirror, one lamp or sun, a sensor on the floor; light that met the object, by all ways, reflected and refracted.

    scripts/count_truth.py                  # all scenes, and the tables of their answers
    scripts/count_truth.py SCENE.toml ...   # these alone, without the tables

Needs Python 3.11 and numpy. The same numbers on any machine but for the last digits.
"""
import json
import pathlib
import sys
import tomllib

import numpy as np

FOLDER = pathlib.Path(__file__).resolve().parent.parent / "scenes" / "truth"
SEED = 20260728
BATCHES = 48  # independent counts, whose spread is known from their differences
STRATA = 1024  # along each side of the square that a batch's photons are drawn from, one in each cell
ROWS_AT_ONCE = 128
WEAK = 1e-3  # of a photon: below this, one in ten goes on, ten times as heavy
MANY = 50  # boundaries: after these, one in two goes on, twice as heavy


def dot(a, b):
    return (a * b).sum(axis=-1)


def unit(a):
    return a / np.linalg.norm(a, axis=-1)[:, None]


def refracted(d, n, eta):
    """Direction beyond a surface of normal n against d, where eta is the index before over the one beyond, and the part of
    unpolarized light that is reflected (Fresnel)."""
    cos_before = -dot(d, n)
    squared = 1 - eta * eta * (1 - cos_before * cos_before)
    cos_beyond = np.sqrt(np.maximum(squared, 0))
    with np.errstate(invalid="ignore"):
        across = (eta * cos_before - cos_beyond) / (eta * cos_before + cos_beyond)
        along = (cos_before - eta * cos_beyond) / (cos_before + eta * cos_beyond)
    passes = (squared > 0) & (cos_before > 0)
    reflectance = np.where(passes, 0.5 * (across**2 + along**2), 1.0)
    return eta * d + (eta * cos_before - cos_beyond)[:, None] * n, reflectance


def reflected(d, n):
    return d - 2 * dot(d, n)[:, None] * n


class Ball:
    def __init__(self, item):
        self.center, self.radius = np.array(item["translation"], float), item["radius"]
        self.reach = self.radius  # m about the center, in which all of it is

    def entry(self, p, d):
        """Distance to where each ray comes in (infinite where it does not), and the normal there."""
        to = p - self.center
        half = dot(to, d)
        squared = half**2 - dot(to, to) + self.radius**2
        t = np.where(squared > 0, -half - np.sqrt(np.maximum(squared, 0)), np.inf)
        return t, unit(to + np.where(squared > 0, t, 0)[:, None] * d)

    def exit(self, p, d):
        to = p - self.center
        t = -2 * dot(to, d)
        return t, unit(to + t[:, None] * d)


class Prism:
    def __init__(self, item):
        self.center = np.array(item["translation"], float)
        radius, half = item["radius"], item["length"] / 2
        self.reach = np.hypot(radius, half)
        turns = [np.deg2rad(angle) for angle in (150, 270, 30)]
        normals = [(np.cos(a), np.sin(a), 0) for a in turns] + [(0, 0, 1), (0, 0, -1)]
        self.normals = np.array(normals) @ rotation(item["rotation"]).T
        self.offsets = np.array([radius / 2] * 3 + [half] * 2) + self.normals @ self.center

    def entry(self, p, d):
        slope = d @ self.normals.T
        t = (self.offsets - p @ self.normals.T) / slope
        first, last = np.where(slope < 0, t, -np.inf), np.where(slope > 0, t, np.inf)
        face = first.argmax(axis=1)
        enters = first.max(axis=1)
        return np.where(enters < last.min(axis=1), enters, np.inf), self.normals[face]

    def exit(self, p, d):
        slope = d @ self.normals.T
        t = np.where(slope > 0, (self.offsets - p @ self.normals.T) / slope, np.inf)
        return np.maximum(t.min(axis=1), 0), self.normals[t.argmin(axis=1)]


def rotation(degrees):
    """Of angles about x, then y, then z."""
    matrix = np.eye(3)
    for axis, angle in enumerate(np.deg2rad(degrees)):
        turn = np.eye(3)
        i, j = (axis + 1) % 3, (axis + 2) % 3
        turn[i, i] = turn[j, j] = np.cos(angle)
        turn[i, j], turn[j, i] = -np.sin(angle), np.sin(angle)
        matrix = turn @ matrix
    return matrix


class Sensor:
    def __init__(self, item):
        self.corner, self.size = item["corner"], (item["u"][0], item["v"][2])
        self.texels = item["resolution"]
        self.area = self.size[0] * self.size[1] / (self.texels[0] * self.texels[1])
        self.lumens = np.zeros(self.texels[0] * self.texels[1])

    def add(self, p, d, lumens):
        with np.errstate(divide="ignore", invalid="ignore"):
            t = (self.corner[1] - p[:, 1]) / d[:, 1]
            column = np.floor((p[:, 0] + t * d[:, 0] - self.corner[0]) / self.size[0] * self.texels[0])
            row = np.floor((p[:, 2] + t * d[:, 2] - self.corner[2]) / self.size[1] * self.texels[1])
            lands = (d[:, 1] < 0) & (t > 0) & (column >= 0) & (column < self.texels[0]) & (row >= 0) & (row < self.texels[1])
        place = (row[lands] * self.texels[0] + column[lands]).astype(np.int64)
        self.lumens += np.bincount(place, lumens[lands], len(self.lumens))

    def take_lux(self):
        lux = self.lumens / self.area
        self.lumens = np.zeros_like(self.lumens)
        return lux


def through_glass(shape, material, p, d, lumens, sensor, random):
    """A convex shape: light that left it does not meet it again. Both parts are followed at every boundary."""
    ior = material["ior"]
    kept = material.get("attenuation_color", [1])[0], material.get("attenuation_distance", 1)
    t, n = shape.entry(p, d)
    meets = np.isfinite(t)
    p, d, lumens, n = p[meets] + t[meets, None] * d[meets], d[meets], lumens[meets], n[meets]
    whole = lumens.max(initial=0)
    inside, reflectance = refracted(d, n, 1 / ior)
    sensor.add(p, reflected(d, n), lumens * reflectance)
    d, lumens = inside, lumens * (1 - reflectance)
    boundaries = 0
    while len(lumens):
        boundaries += 1
        t, n = shape.exit(p, d)
        p = p + t[:, None] * d
        lumens = lumens * kept[0] ** (t / kept[1])
        beyond, reflectance = refracted(d, -n, ior)
        sensor.add(p, beyond, lumens * (1 - reflectance))
        d, lumens = reflected(d, n), lumens * reflectance
        chance = np.where(lumens < WEAK * whole, 0.1, 1.0) * (1 if boundaries < MANY else 0.5)
        goesOn = random.random(len(lumens)) < chance
        p, d, lumens = p[goesOn], d[goesOn], (lumens / chance)[goesOn]


class Ring:
    """A mirror that stands on the floor. Light comes down, so that what it reflects never meets it from outside again."""

    def __init__(self, item):
        self.inner, self.outer = item["radius"], item["radius"] + item["thickness"]
        self.height = item["height"]
        self.center = np.array(item["translation"], float)
        self.reach = np.hypot(self.outer, self.height / 2)

    def wall(self, p, d, radius, side):
        """Distance to a wall, where a ray comes in (side -1) or out (+1); NaN where it does not meet it."""
        a, half = d[:, 0] ** 2 + d[:, 2] ** 2, p[:, 0] * d[:, 0] + p[:, 2] * d[:, 2]
        squared = half**2 - a * (p[:, 0] ** 2 + p[:, 2] ** 2 - radius**2)
        with np.errstate(invalid="ignore"):
            return (-half + side * np.sqrt(squared)) / a

    def bounce(self, p, d, t, radius):
        p = p + t[:, None] * d
        n = p * [1, 0, 1] / radius
        return p, reflected(d, n)

    def follow(self, color, p, d, lumens, sensor):
        p = p + ((self.height - p[:, 1]) / d[:, 1])[:, None] * d
        distance = np.hypot(p[:, 0], p[:, 2])
        t = self.wall(p, d, self.outer, -1)
        meets = (distance > self.outer) & (t > 0) & (p[:, 1] + t * d[:, 1] > 0)
        sensor.add(*self.bounce(p[meets], d[meets], t[meets], self.outer), lumens[meets] * color)
        within = distance < self.inner
        p, d, lumens = p[within], d[within], lumens[within]
        isFirst = True
        while len(lumens):
            t = self.wall(p, d, self.inner, 1)
            meets = p[:, 1] + t * d[:, 1] > 0
            if not isFirst:
                sensor.add(p[~meets], d[~meets], lumens[~meets])
            p, d = self.bounce(p[meets], d[meets], t[meets], self.inner)
            lumens, isFirst = lumens[meets] * color, False


def photons(light, center, reach, square, count):
    """From the lamp into the ball of radius `reach` about `center`, evenly; `square`: places in the unit square."""
    around = 2 * np.pi * square[:, 1]
    if light["type"] == "point":
        source = np.array(light["position"], float)
        axis = center - source
        farness = np.linalg.norm(axis)
        least = np.sqrt(1 - (reach / farness) ** 2)
        lumens = light["intensity"] * 2 * np.pi * (1 - least) / count
        along = 1 - square[:, 0] * (1 - least)
        across = np.sqrt(1 - along**2)
    else:
        axis = np.array(light["direction"], float)
        across = reach * np.sqrt(square[:, 0])
        lumens = light["illuminance"] * np.pi * reach**2 / count
    w = axis / np.linalg.norm(axis)
    u = np.cross(w, [0, 0, 1] if abs(w[2]) < 0.7 else [1, 0, 0])
    u /= np.linalg.norm(u)
    disk = (across * np.cos(around))[:, None] * u + (across * np.sin(around))[:, None] * np.cross(w, u)
    weights = np.full(len(square), lumens)
    if light["type"] == "point":
        return np.broadcast_to(source, disk.shape), along[:, None] * w + disk, weights
    return center - 2 * reach * w + disk, np.broadcast_to(w, disk.shape), weights


def counted(shape, material, light, sensor, seed):
    """lux by texel, and the standard error."""
    batches = []
    for batch in range(BATCHES):
        random = np.random.default_rng([SEED, seed, batch])
        for first in range(0, STRATA, ROWS_AT_ONCE):
            cells = np.stack(np.meshgrid(np.arange(first, first + ROWS_AT_ONCE), np.arange(STRATA)), -1).reshape(-1, 2)
            square = (cells + random.random(cells.shape)) / STRATA
            p, d, lumens = photons(light, shape.center, shape.reach, square, STRATA * STRATA)
            if isinstance(shape, Ring):
                shape.follow(material["color"][0], p - shape.center * [1, 0, 1], d, lumens, sensor)
            else:
                through_glass(shape, material, p, d, lumens, sensor, random)
        batches.append(sensor.take_lux())
    return np.mean(batches, axis=0), np.std(batches, axis=0, ddof=1) / np.sqrt(BATCHES)


def below_slab(item, material, light, sensor):
    """Light of a lamp that is 0, 2, 4 ... times reflected in a wide slab: intensity, over the area of rings on the floor."""
    thickness, ior = item["size"][1], material["ior"]
    source = np.array(light["position"]) - sensor.corner
    angle = np.linspace(1e-6, np.deg2rad(89), 200001)
    down = np.stack([np.sin(angle), -np.cos(angle), 0 * angle], -1)
    inside, reflectance = refracted(down, np.array([0.0, 1, 0]) + 0 * down, 1 / ior)
    cos_in = -inside[:, 1]
    once = material["attenuation_color"][0] ** (thickness / cos_in / material["attenuation_distance"])
    points = [(np.arange(8 * n) + 0.5) / (8 * n) * size for n, size in zip(sensor.texels, sensor.size)]
    distance = np.hypot(points[0][None, :] - source[0], points[1][:, None] - source[2])
    lux = np.zeros_like(distance)
    for times in range(12):
        ways = 2 * times + 1
        radius = (source[1] - thickness) * np.tan(angle) + ways * thickness * inside[:, 0] / cos_in
        growth = (source[1] - thickness) / np.cos(angle) ** 2 + ways * thickness * np.cos(angle) / (ior * cos_in**3)
        part = (1 - reflectance) ** 2 * reflectance ** (2 * times) * once**ways
        lux += np.interp(distance, radius, light["intensity"] * np.sin(angle) * part / (radius * growth))
    return lux.reshape(sensor.texels[1], 8, sensor.texels[0], 8).mean(axis=(1, 3)).ravel()


def below_wave(item, material, light, sensor):
    """Each point of the surface sends its light to one place of the bed; points so dense that each texel has thousands."""
    wave = item["waves"][0]
    rate = 2 * np.pi / wave["wavelength"]
    count, low, width = 1 << 24, sensor.corner[0] - 0.5, sensor.size[0] + 1
    lux = np.zeros(sensor.texels[0])
    for x in np.array_split(low + (np.arange(count) + 0.5) / count * width, 32):
        height, slope = wave["amplitude"] * np.sin(rate * x), wave["amplitude"] * rate * np.cos(rate * x)
        n = np.stack([-slope, np.ones_like(x), 0 * x], -1) / np.sqrt(1 + slope**2)[:, None]
        d, reflectance = refracted(np.array([0.0, -1, 0]) + 0 * n, n, 1 / material["ior"])
        place = x - (height - sensor.corner[1]) / d[:, 1] * d[:, 0]
        texel = np.floor((place - sensor.corner[0]) / sensor.size[0] * sensor.texels[0])
        lands = (texel >= 0) & (texel < sensor.texels[0])
        lumens = light["illuminance"] * width / count * (1 - reflectance)
        lux += np.bincount(texel[lands].astype(np.int64), lumens[lands], sensor.texels[0])
    return np.tile(lux * sensor.texels[0] / sensor.size[0], sensor.texels[1])


def answer(scene, seed):
    """lux by texel, and their standard error: 0 where the answer is exact."""
    materials = {material["name"]: material for material in scene["material"]}
    item = next(o for o in scene["object"] if materials[o["material"]]["type"] != "diffuse")
    material, light, sensor = materials[item["material"]], scene["light"][0], Sensor(scene["sensor"][0])
    if item["shape"] == "box":
        return below_slab(item, material, light, sensor), 0
    if item["shape"] == "water":
        return below_wave(item, material, light, sensor), 0
    shape = {"sphere": Ball, "prism": Prism, "ring": Ring}[item["shape"]](item)
    return counted(shape, material, light, sensor, seed)


def write_answer(file, seed):
    scene = tomllib.loads(file.read_text())
    lux, error = answer(scene, seed)
    columns, rows = scene["sensor"][0]["resolution"]
    with open(file.with_suffix(".pfm"), "wb") as out:
        out.write(b"Pf\n%d %d\n-1\n" % (columns, rows) + lux.astype("<f4").tobytes())
    mean = lux.mean()
    about = {
        "scene": file.stem,
        "what": file.read_text().splitlines()[0].removeprefix("# "),
        "texels": [columns, rows],
        "mean_lux": float(f"{mean:.6g}"),
        "peak_lux": float(f"{lux.max():.6g}"),
        "spread": float(f"{np.sqrt(np.mean(np.square(error))) / mean:.3g}"),
    }
    print(json.dumps(about), flush=True)
    return about


def write_tables(answers):
    lines = ["{\n" + ",\n".join(f'    "{key}": {json.dumps(value)}' for key, value in about.items()) + "\n  }" for about in answers]
    (FOLDER / "answers.json").write_text("[\n  " + ",\n  ".join(lines) + "\n]\n")
    readme = FOLDER / "README.md"
    kept = readme.read_text().split("| file |")[0] if readme.exists() else ""
    rows = ["| file | size | mean lux | peak | spread | what |", "|---|---|---|---|---|---|"]
    for about in answers:
        spread = f"{100 * about['spread']:.2f} %" if about["spread"] else "exact"
        size = " x ".join(map(str, about["texels"]))
        rows.append(f"| {about['scene']}.pfm | {size} | {about['mean_lux']:.5g} | {about['peak_lux']:.4g} | {spread} | {about['what']} |")
    readme.write_text(kept + "\n".join(rows) + "\n")


def main():
    every = sorted(FOLDER.glob("*.toml"))
    asked = [pathlib.Path(name).resolve() for name in sys.argv[1:]]
    seeds = {file: seed for seed, file in enumerate(every)}
    answers = [write_answer(file, seeds.get(file, len(every))) for file in asked or every]
    if not asked:
        write_tables(answers)


if __name__ == "__main__":
    main()
