// SPDX-License-Identifier: BSD-3-Clause
/** Receives the name of a stage and its progress in [0, 1]. */
export type OnProgress = (stage: string, done: number) => void;
/** Coordinates one after the other: 3 for each point, in 2D 2. */
export type Numbers = ArrayLike<number>;
export type Indices = ArrayLike<number>;
/** The content of a file. */
export type Bytes = Uint8Array<ArrayBuffer>;

/** `name` is InputError, OptionError, DefectiveCage, OutOfMemory, Crash, Cancelled or Ended. */
export class FlbcError extends Error {
  /** Of a DefectiveCage: control points of its defects. */
  controlPoints: Int32Array;
}

/** Weights of the model's vertices: those of vertex v are entries starts[v] .. starts[v + 1] - 1. */
export interface Weights {
  starts: Uint32Array; controlPoints: Uint32Array; values: Float32Array;
}

export interface SolveOptions {
  smoothness?: number; tolerance?: number;
  distances?: "auto" | "exact" | "interpolated";
  precision?: "auto" | "single" | "double";
}

/** A mesh, and the weights of its vertices. */
export interface Solution {
  points: Float64Array; cells: Int32Array;
  starts: Uint32Array; controlPoints: Uint32Array; values: Float64Array;
  /** Of `solve()`, for later moves. */
  options?: SolveOptions;
}

export interface Pixels { data: Uint8ClampedArray | Uint8Array; width: number; height: number }
/** Pixels with the place of their upper left corner, in pixels of the result from that of the picture. */
export interface PlacedPixels extends Pixels { data: Uint8Array<ArrayBuffer>; left: number; top: number }

/** The content of a locality file: docs/how-to/locality.md. Control points must not move vertices of the region. */
export type Locality = LocalityMask[] | {
  /** Required without `reach`. */
  masks?: LocalityMask[];
  conflicts?: "fail" | "relax";
  /** Factors from 1/16 to 16; weights extend farther with a larger one. */
  reach?: { control_points: LocalityMask["control_points"]; factor: number }[];
  /** Width of a band next to masks in which weights fade out, as a part of the cage size; 0 to 1. */
  falloff?: number;
  /** Regions that move by one affine map each. */
  solid?: { region: LocalityMask["region"] }[];
};
export interface LocalityMask {
  control_points: number[] | { vertices: number[] } | { box: [number[], number[]] };
  region: number[] | { vertices: number[] } | { box: [number[], number[]] } | { group: string } | { attribute: string };
}

export interface Protection {
  masks: { controlPoints: number[]; vertices: number[] }[];
  /** The factor of each control point; empty if none are given. */
  reach: number[];
  falloff: number;
  /** The vertices of each solid region. */
  solid: number[][];
  /** Vertices on facets of masked control points, which still move them. */
  onFacets: number;
  /** Control points that "relax" removed from the masks. */
  freed: number[];
  /** Vertices that cannot obey, and control points to remove from the masks. Nothing has changed then. */
  conflict?: { vertices: number[]; controlPoints: number[] };
}

export interface ModelFacts {
  dim: 2 | 3; vertices: number;
  /** Whether these are vertices of the interior of an outline, not of the file. */
  isFilled: boolean;
}

export interface CageFacts {
  controlPoints: number; facets: number;
  /** Distance from the model, relative to its size. */
  offset?: number;
  symmetry?: "none" | "x" | "y" | "z";
  /** About narrow gaps of the model that makeCage() bridges; "": none. */
  note?: string;
  /** What a repair changed, one sentence each. */
  changes?: string[];
}

/**
 * One worker with one model. Take the steps in this order: a model, a cage, a mesh of its interior,
 * solve(); then deform() and the files. Calls are answered in the order in which they are made.
 */
export class Flbc {
  /** @param options.wasm where the module is, if it is not inside this file */
  static start(options?: { wasm?: string | URL | Response | ArrayBuffer | Uint8Array }): Promise<Flbc>;
  /** Ends what is being computed; the next call starts without a model. */
  cancel(): Promise<void>;
  /** Ends the worker. */
  end(): void;

  /** .obj, .ply, .stl, .off, .glb, .gltf. @param files others that it names, such as .mtl */
  readModel(name: string, bytes: ArrayBuffer | Uint8Array,
            files?: Record<string, ArrayBuffer | Uint8Array>): Promise<ModelFacts>;
  setModel(points: Numbers, triangles: Indices): Promise<ModelFacts>;

  /** `offset` is relative to the size of the model, `density` of control points at each vertex to a usual cage. By default, all are chosen. */
  makeCage(options?: { controlPoints?: number; offset?: number; symmetry?: "auto" | "none" | "x" | "y" | "z"; density?: Numbers },
           onProgress?: OnProgress): Promise<CageFacts>;
  readCage(name: string, bytes: ArrayBuffer | Uint8Array): Promise<CageFacts>;
  setCage(points: Numbers, facets: Indices): Promise<void>;
  /** Other control points, which move those of the cage by weights: with {@link Solution} arrays of one row per control
   *  point of the cage. @param options.isCurved three facets each are the control polygon of a cubic Bezier curve, which pages draw */
  compose(options: { points: Numbers; facets: Indices; starts: Indices; controlPoints: Indices; values: Numbers; isCurved?: boolean }): Promise<CageFacts>;
  /** Of the cage that readCage() refused as a DefectiveCage. */
  repairCage(): Promise<CageFacts>;

  /** `seconds` is about how long solve() takes. */
  makeMesh(options?: { vertices?: number }, onProgress?: OnProgress): Promise<{ vertices: number; cells: number; note: string; seconds: number }>;
  setMesh(points: Numbers, cells: Indices): Promise<void>;

  solve(options?: SolveOptions, onProgress?: OnProgress): Promise<{ iterations: number; objective: number; converged: boolean }>;
  /** Regions of the model that control points must not move, their reach, and a falloff, for the next solve() or move({ refine: true }). */
  protect(locality: Locality | ArrayBuffer | Uint8Array): Promise<Protection>;
  /** What makeMesh() and solve() have computed. */
  solution(): Promise<Solution>;
  /** In place of both, for the same model and cage: in another worker, or after cancel(). */
  setSolution(solution: Solution): Promise<void>;
  /** Fewer influences per vertex in all that follows. */
  reduce(options: { influences: number }, onProgress?: OnProgress): Promise<{ influences: number }>;
  /** Another shape of the rest cage; the model stays. Ends after 0.25 s, or `seconds`, if need be
   *  before it has converged; { refine: true } resumes. */
  move(request: ({ points: number[] } | { refine: true }) & { seconds?: number }):
    Promise<{ converged: boolean; iterations: number; residual: number; rest: Float64Array; weights: Weights } | { refused: string }>;

  /** The vertices of the model at rest. */
  points(): Promise<Float64Array>;
  cage(): Promise<{ points: Float64Array; facets: Int32Array }>;
  weights(): Promise<Weights>;
  /** Harmonic coordinates in the same mesh. */
  harmonicWeights(): Promise<Weights>;
  /** The vertices of the model where these control points take it. */
  deform(points: Numbers): Promise<Float64Array>;

  /** JSON for the page of flbc view. */
  content(options?: { picture?: string }): Promise<Bytes>;
  /** A page to deform the model in that needs no other file. */
  page(options?: { picture?: string }): Promise<Bytes>;
  /** A skin of 4 or 8 influences per vertex, with poses of the cage at times in seconds. Of a glTF
   *  file, its whole document is kept. With `rigid`, each solid region has a joint of its own, which
   *  turns it without distortion. */
  glb(options?: { influences?: 4 | 8; rigid?: boolean; times?: number[]; poses?: Numbers[] }): Promise<Bytes>;
  weightFile(options?: { format?: "npy" | "mtx" | "csv"; of?: "model" | "mesh" }): Promise<Bytes>;
  cageFile(): Promise<Bytes>;
  meshFile(): Promise<Bytes>;
  /** The model where these control points take it. */
  modelFile(points: Numbers, extension?: string): Promise<Bytes>;
  /** A picture where poses of the cage take it, on one canvas, which is larger where pixels move
   *  beyond the edge. Pixels outside the cage stay. The mesh of the cage must be there.
   *  @param options.pixels such as ImageData: RGBA, rows from the top
   *  @param options.size width and height in the model (default: a unit per pixel), whose origin is the lower left corner
   *  @param options.scale pixels of the result per pixel (default: 1)
   *  @param options.sheet the name of a sprite sheet to make as well; `fps` (default: 12) is in its JSON */
  picture(options: { pixels: Pixels; poses: Numbers[]; size?: Numbers; scale?: number; sheet?: string; fps?: number }):
    Promise<{ frames: PlacedPixels[]; sheet?: PlacedPixels; json?: string }>;
  /** A document in SVG where these control points take it: only its geometry changes, and what is
   *  outside of the cage stays. The mesh of the cage must be there. @param placing the width and height
   *  of the page, and the matrix from there (y down) to the model, as in SVG. `notes` name what does
   *  not bend. */
  drawing(text: string, placing: { page: Numbers; matrix: Numbers }, points: Numbers): Promise<{ text: string; notes: string[] }>;
  /** Bytes that the module takes. */
  memory(): Promise<number>;
  version(): Promise<string>;
}
