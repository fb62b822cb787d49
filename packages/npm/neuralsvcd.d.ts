// SPDX-License-Identifier: MIT
// Units are metres, axes right-handed. Quaternions are x, y, z, w: not w first. Time is in [0, 1]. Triangles are
// counter-clockwise seen from outside. What is proven, and to which resolution, is in the contracts at the top of
// neuralsvcd.h, whose names are the same but for their spelling. Numbers are rounded to float32.

/** Compiles the module. Await it once before all else; further calls return the same promise. */
export function init(): Promise<void>;

/**
 * What the library refuses. The message names the field at fault. (Values of a wrong type, and options that do not
 * exist, throw a TypeError. A body that was disposed of throws an Error.)
 */
export class SvcdError extends Error {
  /** The name of the result in neuralsvcd.h without NSVCD_ERROR_: 'QUATERNION', 'CLEARANCE'. Of a file, 'SYNTAX'. */
  readonly code: string;
  /** Of a file, the line at fault, from 1; undefined if no line is. */
  readonly line: number | undefined;
}

/** An array, or an object such as three.js has. */
export type Vector3 = Iterable<number> | {x: number; y: number; z: number};
/** Of unit length: x, y, z, w, and not w first. */
export type Quaternion = Iterable<number> | {x: number; y: number; z: number; w: number};
/** Seven numbers, x y z and the quaternion x y z w; or an object that has both, as an Object3D of three.js. */
export type Pose = Iterable<number> | {position: Vector3; quaternion: Quaternion};
export type Bytes = ArrayBuffer | ArrayBufferView;
type Triple = [number, number, number];

export interface Mesh {
  /** Three numbers a vertex. */
  positions: Float32Array;
  /** Three vertex numbers a triangle. */
  indices: Uint32Array;
}

export interface MeshOptions {
  /** The file's name. Its ending helps where the bytes do not tell the format. */
  name?: string;
  /** Metres in one of the file's units: 0.001 for millimetres. Default 1. */
  scale?: number;
  /** The point, in the file's units, that becomes the origin. Default [0, 0, 0]. */
  origin?: Vector3;
  /** No warning about the size. Default false. */
  quiet?: boolean;
}

/**
 * Reads OBJ, STL (binary or text), PLY or GLB. Faces of any number of corners are triangulated. A mesh that is larger than
 * 30 m or smaller than 1 mm is warned of with console.warn, once: `scale` may be wrong.
 * @param data what the file holds, not its name
 */
export function parseMesh(data: Bytes | string, options?: MeshOptions): Mesh;
/** The convex hull of points, three numbers each: a closed mesh. */
export function convexHull(points: ArrayLike<number>): Mesh;
/**
 * The mesh of a height field, z up: the sample of a row and a column is at (column * step[0], row * step[1]). NaN: there
 * is no sample. Encode it as `open`.
 * @param heights rows * columns metres, row by row
 */
export function heightField(heights: ArrayLike<number>, rows: number, columns: number,
                            step: readonly [number, number]): Mesh;

export interface BodyOptions {
  /** How many patches the surface is cut into, up to 65536. Default by the number of triangles. */
  patches?: number;
  /** Metres: as many patches as give each about this radius. For a level, half the size of what moves in it. */
  patchRadius?: number;
  /** Metres: the body is everything within this distance of the mesh. Default 0. */
  convexRadius?: number;
  /** The mesh is a sheet, or a part cut out: nothing is inside it. Default false. */
  open?: boolean;
  /** Triangles are stored with 16 bits a coordinate: fewer bytes, and a facts.quantizationError. Default false. */
  coarse?: boolean;
}

/** What a body is, in its own frame. */
export interface BodyFacts {
  /** Bytes. */
  readonly size: number;
  readonly patches: number;
  /** A sphere that contains the body. */
  readonly centre: readonly number[];
  readonly radius: number;
  /** No point of the mesh is farther from the origin. */
  readonly extent: number;
  /** A box that contains the mesh. */
  readonly low: readonly number[];
  readonly high: readonly number[];
  readonly meanPatchRadius: number;
  readonly triangles: number;
  /** Triangles, and parts of them, patch by patch. */
  readonly storedTriangles: number;
  /** Verdicts are about triangles that are within this of the mesh's. */
  readonly quantizationError: number;
  readonly convexRadius: number;
  /** Of the mesh, and those among them that are not closed, so that nothing is inside them for certain. */
  readonly components: number;
  readonly openComponents: number;
  readonly openEdges: number;
  /** It was encoded as `open`. */
  readonly open: boolean;
}

/**
 * A mesh, encoded once and asked about often. Its memory is the module's: it is freed when the object is collected, or
 * by dispose().
 */
export class Body {
  /** Without indices, every three vertices are a triangle. Both are copied. Other properties are refused. */
  constructor(mesh: {positions: ArrayLike<number>; indices?: ArrayLike<number> | null}, options?: BodyOptions);
  /** Centred at the origin. */
  static sphere(radius: number): Body;
  /** All within `radius` of the segment. */
  static capsule(from: Vector3, to: Vector3, radius: number): Body;
  /**
   * Centred at the origin.
   * @param half half the lengths: [1, 1, 1] is a cube of side 2. They include the radius of rounded edges
   * @param convexRadius that radius; default 0
   */
  static box(half: Vector3, convexRadius?: number): Body;
  /** Spheres about points, three numbers each: a point cloud, or a map of voxels. */
  static cloud(points: ArrayLike<number>, radius: number): Body;
  /** A body from toBytes() or of `svcd encode`. Every byte is checked. */
  static fromBytes(bytes: Bytes): Body;
  /** A copy, to be stored, or sent to a worker. */
  toBytes(): Uint8Array;
  readonly facts: BodyFacts;
  /** Frees the memory now. The body cannot be used any more. */
  dispose(): void;
}

/** A body in a question: its motion and its size. */
export interface Mover {
  body: Body;
  /**
   * Up to 65536, or one flat array of seven numbers each. Between two of them the rotation is a slerp, and the pivot goes
   * straight. One pose: it rests there. Default: it rests at the origin. None, [], is refused.
   */
  poses?: readonly Pose[] | ArrayLike<number>;
  /** Of the poses, rising from 0 to 1. Default: uniform. */
  times?: ArrayLike<number>;
  /** Of the body about its origin, 1e-6 to 1e6. Default 1. */
  scale?: number;
  /** The point of the body, before scaling, that goes straight: the centre of mass, a hinge. Default the origin. */
  pivot?: Vector3;
}

export interface Question {
  /** Either may move, or both, over the same time. */
  a: Mover;
  b: Mover;
  /** 'hit': do they hit at all? 'first': when first? 'distance': how near do they come? Default 'hit'. */
  ask?: 'hit' | 'first' | 'distance';
  /**
   * Metres, how exact the answer has to be. 'first': nothing moves farther than this from time.low to time.high.
   * 'distance': the bracket is no wider. Not for 'hit'. Default a thousandth of the smaller body's radius.
   */
  to?: number;
  /** The same for 'first' as a share of the motion, up to 1. */
  toTime?: number;
  /** Metres: to come within this distance is a hit. Default 0. */
  clearance?: number;
  /** Metres: a contact at the start that is no deeper does not count, so that a body may rest on another or leave it. */
  slop?: number;
  /** Metres: what comes within the clearance and this, but not within the clearance, may be left undecided. */
  tolerance?: number;
  /** 'first': up to four contacts, which hold the body. Default: one. */
  manifold?: boolean;
  /** The question is about surfaces alone: a body inside the other is free of it. */
  surfaces?: boolean;
  /** Units of work that the proof may take. Default 10 million; for 'distance' 100,000. */
  work?: number;
  /** 16, 32, 48 or 64, the default: the most segments that an interval of the motion is cut into. */
  segments?: number;
}

/** The number is no less than low and no more than high. Infinity: it is not known. */
export interface Range {
  low: number;
  high: number;
}

/** Two triangles, and where they meet or are nearest. */
export interface Contact {
  /** World. */
  point: Triple;
  /** Unit, world, from b to a; 0 if there is no direction. */
  normal: Triple;
  /** Metres between the triangles; 0: they meet. */
  gap: number;
  time: number;
  /** As numbered in the meshes; null if none are named. */
  triangleA: number | null;
  triangleB: number | null;
  patchA: number;
  patchB: number;
  /** In a manifold: of what touches. It is the same as long as that does. */
  id: number;
}

export interface Answer {
  /**
   * 'free': proven, the surfaces never come within the clearance, and neither body is inside the other. 'hit': proven,
   * they do, or one is inside the other at the start. 'undecided': neither is proven; `why` tells the reason.
   */
  verdict: 'free' | 'hit' | 'undecided';
  /**
   * Why the verdict is undecided, or a bracket wider than asked: surfaces come 'too near' without meeting; the limit of
   * 'work' was reached; something seems to be inside an 'open' mesh (see BodyOptions.open). null: all is answered.
   */
  why: null | 'too near' | 'work' | 'open';
  /** A hit because one body is inside the other at the start. */
  inside: boolean;
  /**
   * Of the first contact: the bodies are free before low, and in contact at high. Only 'first' brings these together.
   * Else low is 0, and high the time of a contact, perhaps not the first. Free: both are 1.
   */
  time: Range;
  /** Metres: the least distance over the motion, or up to time.high of a hit. */
  distance: Range;
  /** Where the bodies may go: their poses at time.low, pushed out of what they touch by `slop`. */
  safe: {
    time: number;
    a: {position: Triple; quaternion: [number, number, number, number]};
    b: {position: Triple; quaternion: [number, number, number, number]};
  };
  /** Metres: of a contact at the start. 0: there is none. Infinity: nothing ends it. */
  depth: number;
  /** Metres, world: by what a was pushed out of b for the slop. */
  pushOut: Triple;
  /** Of a hit whose triangles are known, at time.high: one, or a manifold. */
  contacts: Contact[];
  /** What distance.high is about, whatever the verdict. */
  nearest: Contact;
  /** Units that the proof took. */
  work: number;
}

/** Answers a question. It takes microseconds to milliseconds; `work` sets a limit. */
export function sweep(question: Question): Answer;
