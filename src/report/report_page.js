"use strict";
(() => {
  const root = document.documentElement;
  addEventListener("error", (event) => { root.dataset.error = event.message; });

  const numbers = JSON.parse(document.getElementById("numbers").textContent);
  const pictures = JSON.parse(document.getElementById("pictures").textContent);

  const element = (tag, attributes = {}, ...children) => {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    made.append(...children.filter((child) => child !== null));
    return made;
  };
  const byId = (id) => document.getElementById(id);

  const none = "–";
  const rounded = (value, digits = 3) =>
    Math.abs(value) >= 10 ** digits ? value.toFixed(0) : Number(value.toPrecision(digits)).toString();
  const percent = (value) => (value === null || value === undefined ? none : `${rounded(100 * value)} %`);
  const plain = (value, digits = 3) => (value === null || value === undefined ? none : value.toFixed(digits));
  const duration = (ms) => (ms >= 180000 ? `${rounded(ms / 60000)} min` : ms >= 1000 ? `${rounded(ms / 1000)} s` : `${rounded(ms)} ms`);
  const memory = (bytes) => (bytes > 0 ? `${rounded(bytes / 2 ** 20)} MiB` : none);
  const counted = (value) => String(value).replace(/\B(?=(\d{3})+$)/g, "\u202f");

  // The curve of the name: light reflected inside a circle touches it.
  const drawCurve = () => {
    const points = Array.from({ length: 181 }, (_, i) => {
      const t = (i / 180) * 2 * Math.PI;
      return `${(3 * Math.cos(t) - Math.cos(3 * t)).toFixed(3)},${(3 * Math.sin(t) - Math.sin(3 * t)).toFixed(3)}`;
    });
    byId("curve").setAttribute("d", `M${points.join("L")}Z`);
  };

  const drawHeader = () => {
    byId("title").textContent = numbers.scene;
    byId("what-differs").textContent = numbers.what_differs;
    byId("command").textContent = numbers.command;
    const fact = (name, value) => element("li", {}, element("b", {}, name), value);
    byId("facts").append(
      fact("picture", numbers.view.size.join(" × ")), fact("device", numbers.device), fact("paths", numbers.paths === numbers.technique_paths ? numbers.paths : `${numbers.paths}, of techniques ${numbers.technique_paths}`),
      fact("dispersion", numbers.spectrum), fact("time", `${numbers.time_s} s`));
    byId("footer").textContent = `Made by ${numbers.program}. All numbers, with their units: report.json. Linear images: the EXR files beside this page.`;
  };

  const layerCells = (layer, hasSensor) => [
    plain(layer.flux_ratio, 4), percent(layer.relative_rmse), percent(layer.noise_floor), percent(layer.mape),
    percent(layer.counted_fraction), ...(hasSensor ? [plain(layer.z_score_rms, 2)] : []),
  ].map((text) => element("td", {}, text));

  const techniqueRows = (technique, hasSensor) => {
    const layers = Object.entries(technique.layers);
    const tall = (text) => element("td", { rowspan: layers.length }, text);
    const body = element("tbody", { "data-technique": technique.name });
    layers.forEach(([name, layer], i) => {
      const row = element("tr", i === 0 ? { class: "first" } : {});
      if (i === 0) row.append(element("th", { scope: "rowgroup", rowspan: layers.length }, technique.name));
      row.append(element("td", { class: "layer" }, name), ...layerCells(layer, hasSensor));
      if (i === 0) {
        if (!hasSensor) row.append(tall(technique.ldr_flip ? plain(technique.ldr_flip.mean) : none));
        row.append(tall(duration(technique.frame_ms)), tall(duration(technique.prepare_ms)), tall(memory(technique.memory_bytes)));
      }
      body.append(row);
    });
    return body;
  };

  const referenceRows = (side) => {
    const { passes, photons_a_pass, noise, seconds } = side.reference;
    const about = `${counted(passes)} passes of ${counted(photons_a_pass)} photons, noise ${percent(noise)}`;
    return element("tbody", { class: "reference" }, element("tr", { class: "first" },
      element("th", { scope: "row" }, "reference"),
      element("td", { class: "layer", colspan: 7 }, about),
      element("td", {}, duration(1000 * seconds), element("small", {}, "in all")),
      element("td", {}, none), element("td", {}, none)));
  };

  const table = (side) => {
    const hasSensor = Boolean(side.sensor);
    const titles = ["", "layer", "flux ratio", "relative RMSE", "of it noise", "MAPE", "pixels counted",
      hasSensor ? "z" : "LDR-FLIP", hasSensor ? "time to read" : "time per frame", "to prepare", "memory"];
    const head = titles.map((title, i) => element("th", { scope: "col", ...(i === 1 ? { class: "layer" } : {}) }, title));
    return element("div", { class: "card scroll", tabindex: 0, role: "region", "aria-label": "Errors and times" },
      element("table", {}, element("thead", {}, element("tr", {}, ...head)), referenceRows(side),
        ...side.techniques.map((technique) => techniqueRows(technique, hasSensor))));
  };

  const amount = (scale, value) => `${value > 0 && scale.signed ? "+" : value < 0 ? "−" : ""}${rounded(Math.abs(value))} ${scale.unit}`.trim();

  const legend = (scale) => {
    const colors = scale.signed ? pictures.legends.signed : pictures.legends.magnitude;
    const ends = scale.signed ? [-scale.bound, 0, scale.bound] : [0, scale.bound];
    const texts = ends.map((value) => element("span", {}, amount(scale, value)));
    const box = element("div", { class: "legend" },
      element("div", { class: "bar", style: `background: linear-gradient(to right, ${colors.join(", ")})` }),
      element("div", { class: "ends" }, ...texts));
    if (scale.signed) box.append("blue: too dark, red: too bright, gray: nothing to compare with");
    return box;
  };

  const slider = (side, shown, index) => {
    const name = side.techniques[index].name;
    const [width, height] = side.size;
    const below = element("img", { alt: `Image of ${name}`, width, height });
    const above = element("img", { alt: "Image of the reference", width, height });
    const range = element("input", { type: "range", min: 0, max: 100, step: 1, value: 50,
      "aria-label": "Part of the picture that shows the reference, in percent" });
    const figure = element("figure", { class: width < 400 ? "slider coarse" : "slider" }, below,
      element("div", { class: "over" }, above), element("div", { class: "line" }), range,
      element("span", { class: "badge left" }, "reference"), element("span", { class: "badge right" }, name));
    range.addEventListener("input", () => figure.style.setProperty("--split", `${range.value}%`));
    const scaleBox = element("div");
    const buttons = shown.views.map((view) => element("button", { type: "button" }, view.name));
    const show = (which) => {
      above.src = shown.views[which].reference;
      below.src = shown.views[which].techniques[index];
      scaleBox.replaceChildren(...(shown.views[which].scale ? [legend(shown.views[which].scale)] : []));
      buttons.forEach((button, i) => button.setAttribute("aria-pressed", i === which));
    };
    buttons.forEach((button, i) => button.addEventListener("click", () => show(i)));
    show(0);
    return element("div", { style: `--aspect: ${width / height}` },
      element("div", { class: "views", role: "group", "aria-label": "What is shown" }, ...buttons), figure, scaleBox);
  };

  const tile = (value, text) => element("div", { class: "card" }, element("b", {}, value), element("span", {}, text));

  const tiles = (side, technique) => {
    const layers = technique.layers;
    const name = ["caustics seen directly", "caustics", "total"].find((layer) => layer in layers);
    const layer = layers[name];
    return element("div", { class: "tiles" },
      tile(plain(layer.flux_ratio), `flux ratio, ${name}`),
      tile(percent(layer.relative_rmse), `relative RMSE, ${name}; ${percent(layer.noise_floor)} is noise`),
      technique.ldr_flip ? tile(plain(technique.ldr_flip.mean), "LDR-FLIP, mean") : tile(plain(layer.z_score_rms, 2), `z, ${name}`),
      tile(duration(technique.frame_ms), side.sensor ? "time to read" : "time per frame"));
  };

  const leftOut = (name) => {
    const all = numbers.left_out.filter((item) => item.technique === "" || item.technique === name);
    const list = (items) => element("ul", {}, ...items.map((item) => element("li", {}, item.what)));
    const here = all.filter((item) => item.concerns_scene);
    const elsewhere = all.filter((item) => !item.concerns_scene);
    return element("div", { class: "left-out" }, element("h3", {}, "Left out, compared with the reference"), list(here),
      elsewhere.length > 0 ? element("details", {}, element("summary", {}, `What is not in this scene (${elsewhere.length})`), list(elsewhere)) : null);
  };

  const enlarge = (map) => {
    const dialog = byId("enlarged");
    dialog.querySelector("figure").replaceChildren(
      element("figcaption", {}, map.name), element("img", { src: map.image, alt: map.name }), legend(map.scale));
    dialog.showModal();
  };

  const mapFigure = (map, size) => {
    const button = element("button", { type: "button", "aria-label": `Enlarge: ${map.name}`, ...(size[0] < 400 ? { class: "coarse" } : {}) },
      element("img", { src: map.image, alt: map.name, width: size[0], height: size[1], loading: "lazy" }));
    button.addEventListener("click", () => enlarge(map));
    return element("figure", { class: "card" }, element("figcaption", {}, map.name), button, legend(map.scale));
  };

  const techniqueSection = (side, shown, technique, index) => element("section", {},
    element("div", { class: "heading" }, element("h2", {}, technique.name),
      element("p", {}, side.sensor ? `on the sensor ${side.sensor}, against counted photons` : `source ${technique.source}, on ${technique.device}`)),
    element("div", { class: "technique" }, slider(side, shown, index),
      element("aside", {}, tiles(side, technique), side.sensor ? null : leftOut(technique.name))),
    element("div", { class: "maps" }, ...shown.maps[index].map((map) => mapFigure(map, side.size))));

  const sideSections = (side, shown, title, note) => [
    element("section", {}, element("div", { class: "heading" }, element("h2", {}, title), element("p", {}, note)), table(side)),
    ...side.techniques.map((technique, i) => techniqueSection(side, shown, technique, i)),
  ];

  drawCurve();
  drawHeader();
  byId("report").append(...sideSections(numbers.view, pictures.view, "At a glance", "the camera's image, luminance in nit"));
  numbers.sensors.forEach((sensor, i) => byId("report").append(
    ...sideSections(sensor, pictures.sensors[i], `Sensor “${sensor.sensor}”`, `${sensor.size.join(" × ")} texels, illuminance in lux`)));
  root.dataset.ready = "true";
})();
