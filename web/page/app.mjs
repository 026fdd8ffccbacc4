// SPDX-License-Identifier: BSD-3-Clause
// The page: from a dropped file to a model that is dragged by its cage.
import { Camera } from "../../libflbc/front/page/camera.mjs";
import { portion } from "../../libflbc/front/page/colors.mjs";
import { decodeContent, inFile, inSpace } from "../../libflbc/front/page/data.mjs";
import { Deformer } from "../../libflbc/front/page/deformer.mjs";
import { kNoWebGl, show } from "../../libflbc/front/page/main.mjs";
import { element, setTheme, tell } from "../../libflbc/front/page/panel.mjs";
import { interpolatePoses, kFrames, straightKeys } from "../../libflbc/front/page/poses.mjs";
import { download } from "../../libflbc/front/page/saving.mjs";
import { pointAt } from "../../libflbc/front/page/vectors.mjs";
import { Flbc } from "../js/flbc.mjs";
import { unpacked } from "../js/unpacked.mjs";
import { cageToObj, curvedCage, mergePoints, piecesOf, splitEdge, straightCage } from "./cage_edits.mjs";
import { decoded } from "./decoding.mjs";
import { bindProtecting, Protector } from "./protecting.mjs";
import { bindReshaping, Reshaper } from "./reshaping.mjs";
import { playingDrawing, pngOf, zipOf } from "./frames.mjs";
import { readPicture, Sketch, wholePicture } from "./shapes.mjs";

const kVertices = 6000;   // of the mesh of the interior
const kPreview = 20000;   // points that are drawn while a model is computed
const kMoves = 1e-4;      // of the cage size: less is no movement
const kPicture = /\.(png|jpe?g|webp|gif)$/i;
const kDrawing = /\.svg$/i;
const kScreens = ["start", "busy", "drawing"];
const kParts = ["stage", "timeline", "panel", "keyHelp"];
const sentence = (text = "") => text.slice(0, 1).toUpperCase() + text.slice(1);
const kForPrograms = /\bk[A-Z]\w+|--[a-z]|\bflbc [a-z]/;  // names and options that this page does not have

// What a message says to people who draw.
function plain(message) {
  return message.split("; ").filter((part, k) => k === 0 || !kForPrograms.test(part)).join("; ");
}

function fileOf(cage) {
  return { name: "cage.obj", bytes: new TextEncoder().encode(cageToObj(cage)) };
}

class App {
  constructor() {
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) element("moving").pauseAnimations();
    this.fresh = kParts.map((id) => element(id).cloneNode(true));
    this.model = null;   // the one that is shown: name, bytes, files, picture, theme
    this.cage = null;    // its cage, as a file: name, bytes; or with curves: points, facets
    this.solution = null;
    this.sketch = new Sketch(element("sketch"), (svg) => this.open([new File([svg], "drawing.svg")]));
    this.started = this.start();
    this.started.catch((error) => this.fail(`This browser cannot run WebAssembly as this page needs it: ${error.message}`));
    this.bind();
    if (!document.createElement("canvas").getContext("webgl2")) {
      for (const id of ["drop", "samples"]) element(id).hidden = true;
      return this.fail(kNoWebGl);
    }
    const early = [...globalThis.flbcDropped ?? element("model").files];
    this.goTo("start");
    if (early.length > 0) this.open(early);
  }

  async start() {
    const { wasm, worker, page, samples } = globalThis.flbcAssets;
    this.flbc = await Flbc.start({ wasm: wasm ? await unpacked(wasm) : "flbc.wasm", worker: await unpacked(worker), page });
    // While the visitor looks for a file, the browser compiles what it will need.
    unpacked(samples["limb.obj"]).then((limb) => this.flbc.warmUp("limb.obj", limb)).catch(() => { /* a visitor was faster */ });
  }

  goTo(screen) {
    element("app").hidden = !screen;
    for (const id of kScreens) element(id).hidden = id !== screen;
    for (const id of kParts) element(id).inert = Boolean(screen);
    if (!screen) element("canvas").focus();
    element("license").hidden = screen === "busy";
    element("back").hidden = !this.view;
    if (screen === "start") element("model").value = "";
  }

  // ---------------------------------------------------------------------------------------- steps

  // Runs steps that take long, with their progress. \return whether they were done
  async work(title, steps) {
    this.view?.stopPlaying();
    element("busyTitle").textContent = title;
    element("stages").replaceChildren();
    element("remaining").textContent = "";
    element("preview").hidden = true;
    this.goTo("busy");
    this.isCancelled = false;
    let stage = "";
    const onProgress = (name, done) => {
      if (name !== stage) {
        stage = name;
        const line = document.createElement("li");
        line.textContent = name;
        element("stages").append(line);
      }
      if (done === undefined) element("done").removeAttribute("value");
      else element("done").value = done;
    };
    try {
      if (!this.flbc) onProgress("starting the program");
      await this.started;
      await steps(onProgress);
      return true;
    } catch (error) {
      if (this.isCancelled || error.name === "Cancelled") return false;
      throw error;
    }
  }

  // From a cage to the view.
  async solve(onProgress) {
    await this.renew();
    const mesh = await this.flbc.makeMesh({ vertices: kVertices }, onProgress);
    element("remaining").textContent = mesh.seconds > 2 ? `Solving takes about ${Math.round(mesh.seconds)} s` : "";
    await this.flbc.solve({}, onProgress);
    onProgress("showing the model", 0);
    this.solution = await this.flbc.solution();
    this.protector = null;  // of the view before
    this.prepare();
    await this.prepared;
    await this.display();
  }

  // \param options  of readPicture()
  async open(files, options = {}) {
    if (element("drop").hidden) return;
    element("problem").hidden = true;
    await this.keepReshaped();
    const before = this.state;
    try {
      const model = await this.modelOf([...files], options);
      const isDone = await this.work(model.name, async (onProgress) => {
        onProgress("reading the model", 0);
        await this.flbc.cancel();  // what is prepared
        const { dim, vertices, isFilled } = await this.flbc.readModel(model.name, model.bytes, model.files);
        const points = inSpace(await this.flbc.points(), dim);
        this.preview(points, dim);
        model.isFilled = isFilled;
        if (vertices > 20000) element("remaining").textContent = `This model takes about ${Math.round(vertices / 7000)} s`;
        const { note } = await this.flbc.makeCage({}, onProgress);
        model.note = model.note || sentence(note);
        this.preview(points, dim, await this.flbc.cage());
        Object.assign(this, { model, cage: await this.cageFile(), view: null });
        await this.solve(onProgress);
      });
      if (!isDone) await this.goBack(before);
      else if (model.note) tell(model.note);
    } catch (error) {
      Object.assign(this, before);
      if (this.model) this.prepare();
      this.fail(error.message);
    }
  }

  // The points of a model, and its cage as soon as there is one, before the view. Dragging turns them.
  preview(points, dim, { points: corners = [], facets = [] } = {}) {
    const canvas = element("preview"), context = canvas.getContext("2d");
    const stride = Math.ceil(points.length / 3 / kPreview);
    const shown = Array.from({ length: Math.ceil(points.length / 3 / stride) }, (_, k) => pointAt(points, k * stride));
    const cage = inSpace(corners, dim);
    const camera = Object.assign(new Camera(dim), { width: canvas.width, height: canvas.height });
    camera.frame([...shown.flat(), ...cage]);
    if (corners.length > 0) Object.assign(camera, { yaw: this.previewed.yaw, pitch: this.previewed.pitch });
    this.previewed = camera;
    const draw = () => {
      context.clearRect(0, 0, canvas.width, canvas.height);
      context.fillStyle = context.strokeStyle = getComputedStyle(canvas).color;
      for (const { x, y } of shown.map((place) => camera.project(place))) context.fillRect(x, y, 2, 2);
      context.beginPath();
      for (let f = 0; f < facets.length; f += dim) {
        const [last, ...others] = [...facets.slice(f, f + dim)].reverse().map((i) => camera.project(pointAt(cage, i)));
        context.moveTo(last.x, last.y);
        for (const { x, y } of others) context.lineTo(x, y);
      }
      context.stroke();
    };
    canvas.hidden = false;
    canvas.onpointermove = ({ buttons, movementX, movementY }) => {
      if (buttons !== 1) return;
      camera.orbit(movementX, movementY);
      draw();
    };
    draw();
  }

  // What a step that fails or is cancelled leaves as it was.
  get state() {
    const { model, cage, solution, view, protector } = this;
    return { model, cage, solution, view, protector };
  }

  async openSample(name) {
    await this.open([new File([await unpacked(globalThis.flbcAssets.samples[name])], name)]);
  }

  // What the module reads, of files that were dropped together.
  async modelOf(files, options) {
    const first = (kind) => files.find(({ name }) => kind.test(name));
    const main = first(/\.(obj|ply|stl|off|glb|gltf|vrm)$/i) ?? first(kDrawing) ?? first(kPicture);
    if (!main) throw new Error(`${files[0].name}: unknown file format; drop a .glb, .gltf, .vrm, .obj, .ply, .stl, .off, .svg, .png, .jpg, .webp, or .gif`);
    if (kDrawing.test(main.name) || kPicture.test(main.name)) {
      const filling = files.find((file) => file !== main && kPicture.test(file.name));
      const { obj, ...looks } = await readPicture(main, { filling, ...options });
      return { name: main.name.replace(/[^.]*$/, "obj"), bytes: new TextEncoder().encode(obj), files: {}, sources: files, ...looks };
    }
    const others = {};
    for (const file of files) if (file !== main) others[file.name] = await file.arrayBuffer();
    const pictures = /obj$/i.test(main.name) ? files.filter(({ name }) => kPicture.test(name)) : [];
    const isNamed = Object.keys(others).some((name) => /\.mtl$/i.test(name));
    const { picture = "" } = pictures.length === 1 && !isNamed ? await readPicture(pictures[0], { keepsBackground: true }) : {};
    const model = { name: main.name, bytes: await main.arrayBuffer(), files: others, picture };
    return /\.(glb|gltf|vrm)$/i.test(main.name) ? decoded(model, globalThis.flbcAssets.decoders) : model;
  }

  async cageFile() {
    return { name: "cage.obj", bytes: await this.flbc.cageFile() };
  }

  get isCurved() { return Boolean(this.cage?.facets); }

  async readCage(cage) {
    if (!cage.facets) return this.flbc.readCage(cage.name, cage.bytes);
    const { cage: pieces, map } = piecesOf(cage);
    await this.flbc.setCage(pieces.points, pieces.facets);
    return this.flbc.compose({ ...cage, ...map, isCurved: true });
  }

  // Another cage for the model. \param make  makes it \param file  it, where it is a file
  // \param numbers  its control points, by those of before, where these stay
  async remake(title, make, { file = null, numbers = null } = {}) {
    await this.keepReshaped();
    const before = this.state;
    element("cageProblem").hidden = true;
    element("repair").hidden = true;
    let note = "";
    try {
      const isDone = await this.work(title, async (onProgress) => {
        await this.prepared;
        const made = await make(onProgress);
        note = sentence(made?.note);
        this.cage = file ?? await this.cageFile();
        await this.solve(onProgress);
      });
      if (!isDone) return await this.goBack(before);
    } catch (error) {
      return await this.refuse(error, before);
    }
    if (note) tell(note);
    if (before.protector) this.protector.density = before.protector.density;
    if (!before.protector?.isUsed) return;
    if (numbers) await this.protector.load(before.protector.renumbered(numbers));
    else tell("Protected regions and reach are gone: they were of control points of the old cage");
  }

  // To the cage that was solved last, also where a defective one is shown.
  async goBack(before) {
    Object.assign(this, before);
    if (!this.model) return this.goTo("start");
    this.prepare();
    if (this.view.deformer.weights.values.length === 0) {
      await this.prepared;
      await this.display();
    }
    this.goTo(null);
  }

  // A cage that does not do. Its defects are shown at their places; dragging goes on with the old one.
  async refuse(error, before) {
    if (error.name === "DefectiveCage") {
      await this.display();
      this.view.editor.select(error.controlPoints);
      element("repair").hidden = false;
      this.goTo(null);
    } else {
      await this.goBack(before);
    }
    element("cageSection").open = true;
    Object.assign(element("cageProblem"), { textContent: plain(error.message), hidden: false });
  }

  // The cage and the solution of the view, if it has been reshaped.
  async keepReshaped() {
    const { reshaper } = this.view ?? {};
    if (!reshaper || (reshaper.solved === this.kept && !reshaper.isBusy)) return;
    this.cage = this.isCurved ? await this.flbc.cage() : await this.cageFile();
    this.solution = await this.flbc.solution();
    this.kept = reshaper.solved;
  }

  // A new worker with the model and its cage. The memory of the old one has grown, and never shrinks.
  async renew() {
    const { model, flbc } = this;
    await flbc.cancel();
    await flbc.readModel(model.name, model.bytes, model.files);
    await this.readCage(this.cage);
  }

  // Brings a new worker to where the last one was.
  prepare() {
    const masks = this.protector?.accepted ?? [];
    this.prepared = this.renew().then(() => this.flbc.setSolution(this.solution)).then(() => this.flbc.protect(masks));
    this.prepared.catch(() => {});
  }

  fail(message) {
    Object.assign(element("problem"), { textContent: plain(message), hidden: false });
    this.goTo("start");
  }

  // ----------------------------------------------------------------------------------------- view

  async display() {
    const { picture } = this.model;
    const json = JSON.parse(new TextDecoder().decode(await this.flbc.content({ picture })));
    this.listening?.abort();
    this.listening = new AbortController();
    const old = this.view;
    const open = [...document.querySelectorAll("#panel details[open]")].map(({ id }) => id);
    kParts.forEach((id, k) => element(id).replaceWith(this.fresh[k].cloneNode(true)));
    this.goTo(null);
    const content = decodeContent(json);
    content.movesOnCard = false;
    this.view = show(content, this.listening.signal);
    if (!this.view) return;
    if (old) {
      const { yaw, pitch, basis } = old.camera;
      Object.assign(this.view.camera, { yaw, pitch, basis });
      setTheme(this.view, old.theme);
    } else if (this.model.theme) {
      setTheme(this.view, this.model.theme);
    }
    this.addSections(content.weights.values.length > 0);
    for (const id of open) element(id).open = true;
  }

  addSections(isSolved) {
    element("facts").insertAdjacentHTML("afterend", '<button data-do="home">New model</button>');
    element("help").closest("section").before(element("sections").content.cloneNode(true));
    const button = element("saveAnimation").cloneNode(true);
    button.dataset.save = "animation";
    element("saveAnimation").replaceWith(button);
    element("savePose").closest("section").append(element("files").content.cloneNode(true));
    element("copyCommand").closest(".row").remove();
    for (const section of document.querySelectorAll(".solved")) section.hidden = !isSolved;
    element("curves").setAttribute("aria-pressed", String(this.isCurved));
    element("curves").closest(".row").hidden = this.view.content.dim === 3;
    element("background").hidden = !this.model.isCut;
    for (const button of document.querySelectorAll("[data-save=drawing], [data-save=playing]")) button.hidden = !this.model.drawing;
    document.querySelector(".photo").hidden = !this.model.photo;
    element("cageFile").addEventListener("change", ({ target }) => {
      const [file] = target.files;
      target.value = "";  // or the same file, mended, would be no change
      this.takeCage(file);
    });
    const move = async (request) => {
      try {
        await this.prepared;
        return await this.flbc.move(request);
      } catch (error) {
        return { refused: error.message };
      }
    };
    const reshaper = new Reshaper(this.view, move);
    reshaper.onRefusal = (message) => tell(plain(message));
    reshaper.onWeights = () => {
      this.showsHarmonic = false;
      this.weights = { local: reshaper.viewer.deformer.weights };
    };
    bindReshaping(reshaper);
    this.kept = reshaper.solved;
    const protector = new Protector(this.view, {
      protect: async (locality) => { await this.prepared; return this.flbc.protect(locality); },
      // Another start takes longer than its iterations.
      refine: () => move({ refine: true, seconds: 1 }),
    });
    this.protector = protector;
    bindProtecting(protector);
    protector.tell = (message) => tell(plain(message));
    element("saveLocality").hidden = this.model.isFilled;
    element("paint").addEventListener("click", () => {
      this.compare(false);
      if (reshaper.isOn) reshaper.toggle();
    });
    // While the visitor takes aim, a new worker sets up its solver.
    element("reshape").addEventListener("click", () => {
      if (protector.isOn) protector.toggle();
      if (reshaper.isOn) reshaper.refine();
    });
    this.weights = { local: this.view.deformer.weights };
    this.showsHarmonic = false;
    const { onState } = this.view;
    // Later, because it takes as long as some frames.
    this.view.onState = () => {
      onState();
      this.timer ??= setTimeout(() => {
        this.timer = null;
        if (this.view) this.showShare();
      }, 150);
    };
    this.showShare();
  }

  async compare(isHarmonic) {
    if (this.showsHarmonic === isHarmonic) return;
    const { deformer, reshaper } = this.view;
    if (reshaper.isOn) reshaper.toggle();
    if (isHarmonic) {
      this.weights.local = deformer.weights;
      await this.prepared;
      this.weights.harmonic = await this.flbc.harmonicWeights();
    }
    this.showsHarmonic = isHarmonic;
    deformer.weights = this.weights[isHarmonic ? "harmonic" : "local"];
    this.view.changed();
  }

  // How many vertices the drag moves: with harmonic coordinates too, once they are known.
  showShare() {
    const { editor, deformer } = this.view;
    element("local").setAttribute("aria-pressed", String(!this.showsHarmonic));
    element("harmonic").setAttribute("aria-pressed", String(this.showsHarmonic));
    if (!this.showsHarmonic) this.weights.local = deformer.weights;
    const phrases = Object.entries(this.weights).map(([name, weights]) => {
      const other = new Deformer(weights, deformer.base, deformer.rest);
      other.move(editor.points);
      const moved = other.displacements().filter((length) => length > kMoves * 2 * editor.sphere.radius);
      return `${name}: ${portion(moved.length, deformer.base.length / 3)} move`;
    });
    element("share").textContent = editor.canUndo ? phrases.join("; ") : "drag a control point, then switch";
  }

  // ---------------------------------------------------------------------------------------- saving

  async save(kind) {
    const { content, editor } = this.view;
    const points = inFile(editor.points, content.dim);
    const { title, poses } = content;
    const { name: modelName, picture, drawing, photo } = this.model;
    const rigid = element("rigid").checked && !element("rigidParts").hidden;
    const moved = async (places, options) => this.flbc.picture(
      { pixels: await wholePicture(photo), size: photo.size, poses: places.map((each) => inFile(each, content.dim)), ...options });
    // The points of the frames of the animation.
    const frames = () => {
      if (poses.length < 2) throw new Error("Add two keys to the timeline first");
      const [{ time: begin }, { time: end }] = [poses[0], poses.at(-1)];
      const times = Array.from({ length: Math.round((end - begin) * kFrames) + 1 }, (_, k) => begin + k / kFrames);
      return times.map((time) => interpolatePoses(poses, time));
    };
    const bent = (places) => this.flbc.drawing(drawing.source, drawing.placing, inFile(places, content.dim));
    const extension = /[^.]*$/.exec(modelName)[0].toLowerCase().replace("gltf", "glb");
    const kinds = {
      posed: async () => [`${title}_posed.${extension}`, await this.flbc.modelFile(points, extension)],
      drawing: async () => {
        const { text, notes } = await bent(editor.points);
        this.note = notes.length > 0 ? `Not bent: ${notes.join("; ")}` : "";
        return [`${title}_posed.svg`, text];
      },
      photo: async () => [`${title}_posed.png`, await pngOf((await moved([editor.points])).frames[0])],
      playing: async () => {
        const texts = [];
        for (const places of frames()) texts.push((await bent(places)).text);
        return [`${title}_animated.svg`, playingDrawing(texts, kFrames)];
      },
      frames: async () => {
        const sheet = `${title}.png`;
        const { frames: pictures, sheet: cells, json } = await moved(frames(), { sheet, fps: kFrames });
        const files = { [sheet]: await pngOf(cells), [`${title}.json`]: new TextEncoder().encode(json) };
        for (const [k, frame] of pictures.entries()) files[`frame_${String(k + 1).padStart(4, "0")}.png`] = await pngOf(frame);
        return [`${title}_frames.zip`, zipOf(files)];
      },
      cage: async () => [`${title}_cage.obj`, await this.flbc.cageFile()],
      npy: async () => [`${title}_weights.npy`, await this.flbc.weightFile({ format: "npy" })],
      mtx: async () => [`${title}_weights.mtx`, await this.flbc.weightFile({ format: "mtx" })],
      page: async () => [`${title}.html`, await this.flbc.page({ picture })],
      animation: async () => {
        const keys = straightKeys(poses);
        return [`${title}_animation.glb`, await this.flbc.glb(
          { influences: 8, rigid, times: keys.map(({ time }) => time), poses: keys.map((pose) => inFile(pose.points, content.dim)) })];
      },
      glb4: async () => [`${title}.glb`, await this.flbc.glb({ influences: 4, rigid })],
      glb8: async () => [`${title}_8.glb`, await this.flbc.glb({ influences: 8, rigid })],
    };
    try {
      await this.prepared;
      const { reshaper } = this.view;
      while (reshaper.isBusy || this.protector.isBusy) await new Promise((done) => { setTimeout(done, 100); });
      const [name, bytes] = await kinds[kind]();
      download(name, new Blob([bytes]));
      tell(this.note || `Saved ${name}`);
      this.note = "";
    } catch (error) {
      tell(plain(error.message));
    }
  }

  // ---------------------------------------------------------------------------------------- events

  async takeCage(file) {
    if (!file) return;
    const bytes = await file.arrayBuffer();
    const cage = { name: file.name, bytes };
    await this.remake(`The cage ${file.name}`, () => this.readCage(cage), { file: cage });
  }

  // More or fewer control points, of those that are selected. Regions and reach stay.
  edit(change, wanted = null) {
    const { editor, content, deformer } = this.view;
    const selected = [...editor.selection];
    const { dim, facets } = content, { isCurved } = this;
    const cage = { points: inFile(deformer.rest, dim), facets };
    const isRight = (wanted ? selected.length === wanted : selected.length > 1) && !selected.some((i) => editor.isHandle(i));
    const changed = isRight ? change({ dim, ...isCurved ? straightCage(cage) : cage }, selected) : null;
    if (!changed) return tell(wanted ? "Select two control points with an edge between them" : "Select at least two control points");
    const file = isCurved ? curvedCage(changed) : fileOf(changed);
    return this.remake("Another cage", () => this.readCage(file), { file, numbers: changed.numbers });
  }

  // Gives the edges of the cage handles, or takes them. The pose and its keys stay, as far as they can.
  async toggleCurves() {
    const { view, isCurved, view: { editor, content, deformer, holdsModel } } = this;
    const change = (places) => (isCurved ? straightCage : curvedCage)({ points: inFile(places, 2), facets: content.facets });
    const changed = change(deformer.rest);
    const file = isCurved ? fileOf({ ...changed, dim: 2 }) : changed;
    const posed = (places) => inSpace(Float64Array.from(change(places).points), 2);
    const pose = holdsModel ? null : posed(editor.points);
    const keys = content.poses.map((key) => ({ ...key, points: posed(key.points) }));
    await this.remake(isCurved ? "Straight edges" : "Curved edges", () => this.readCage(file), { file, numbers: [...Array(editor.handles.size || editor.size).keys()] });
    if (this.view === view) return;
    this.view.content.poses = keys;
    if (pose) this.view.editor.restart(pose);
  }

  makeCage() {
    const number = (id) => (element(id).value === "" ? undefined : Number(element(id).value));
    const options = { symmetry: element("symmetry").value };
    if (number("count")) options.controlPoints = number("count");
    if (number("offset")) options.offset = number("offset") / 100;
    if (this.protector?.density.size > 0) options.density = this.protector.densities();
    const kept = { count: element("count").value, offset: element("offset").value, symmetry: options.symmetry };
    return this.remake("Making a cage", (onProgress) => this.flbc.makeCage(options, onProgress))
      .then(() => Object.entries(kept).forEach(([id, value]) => { element(id).value = value; }));
  }

  async cancel() {
    this.isCancelled = true;
    await this.flbc?.cancel();
  }

  bind() {
    const actions = {
      home: () => this.goTo("start"), back: () => this.goTo(null), cancel: () => this.cancel(), makeCage: () => this.makeCage(),
      keepBackground: () => this.open(this.model.sources, { keepsBackground: true }),
      chooseCage: () => element("cageFile").click(),
      repairCage: () => this.remake("Repairing the cage", () => this.flbc.repairCage()),
      curves: () => this.toggleCurves(), split: () => this.edit(splitEdge, 2), merge: () => this.edit(mergePoints),
      showLocal: () => this.compare(false), showHarmonic: () => this.compare(true),
      draw: () => { this.sketch.clear(); this.goTo("drawing"); },
      finishDrawing: () => this.sketch.close(),
    };
    document.addEventListener("click", ({ target }) => {
      const button = target.closest?.("button");
      if (button?.dataset.do) actions[button.dataset.do]();
      if (button?.dataset.save) this.save(button.dataset.save);
      if (button?.dataset.sample) this.openSample(button.dataset.sample);
    });
    element("model").addEventListener("change", ({ target }) => { if (target.files.length) this.open(target.files); });
    window.addEventListener("keydown", (event) => this.key(event), true);
    for (const name of ["dragover", "dragleave", "drop"]) window.addEventListener(name, (event) => this.dragged(event));
  }

  // Keys of the view do nothing while another screen is there.
  key(event) {
    if (element("app").hidden) return;
    event.stopPropagation();
    if (event.key === "Escape" && !element("busy").hidden) this.cancel();
    else if (event.key === "Escape" && this.view) this.goTo(null);
    if (event.key === "Enter" && !element("drawing").hidden) this.sketch.close();
  }

  dragged(event) {
    event.preventDefault();
    const isOver = event.type === "dragover" && element("busy").hidden;
    element("drop").classList.toggle("over", isOver);
    document.body.classList.toggle("over-page", isOver && element("app").hidden);
    if (event.type !== "drop" || !element("busy").hidden) return;
    const files = [...event.dataTransfer.files];
    if (files.length === 0) return;
    if (this.view && element("app").hidden && /\.json$/i.test(files[0].name)) files[0].arrayBuffer().then((bytes) => this.protector.load(bytes));
    else if (this.view && element("app").hidden && /cage/i.test(files[0].name)) this.takeCage(files[0]);
    else this.open(files);
  }
}

globalThis.flbcApp = new App();
