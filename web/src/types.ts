// What the API says (docs/api.md), as far as the page reads it. Members that an older server lacks are optional.

export type JobState =
  | "queued" | "running" | "pausing" | "paused" | "cancelling" | "cancelled" | "succeeded" | "failed";

export interface Progress {
  frame: number;
  frames: number;
  time: number;
  step: number;
  fraction: number;
  seconds_per_frame: number;
  eta_seconds: number | null;
}

export interface Job {
  id: string;
  name: string;
  state: JobState;
  priority: number;
  created: string | null;
  started: string | null;
  ended: string | null;
  attempt: number;
  error: string | null;
  points: number;
  frame_rate: number;
  frames: number;
  progress: Progress;
  links: Record<string, string>;
}

export interface Problem {
  pointer?: string;
  value?: string;
  allowed?: string;
  message?: string;
  detail?: string;
}

export type Json = null | boolean | number | string | Json[] | {[key: string]: Json};
export type JsonObject = {[key: string]: Json};

export interface Plan {
  points: number;
  points_emitted: number;
  frames: number;
  steps: number;
  time_step: number;
  step_bound?: number;
  memory_bytes: number;
  stages: string[];
  materials: {
    name: string;
    points: number;
    bytes_per_point: number;
    fields: {name: string; bytes: number}[];
    wave_speed?: number;
    numerical_viscosity?: number;
  }[];
  warnings: string[];
  choices?: JsonObject;
  quality?: Json;
  scene: JsonObject;
  [more: string]: unknown;
}

export interface ReportFrame {
  frame: number;
  time: number;
  points: number;
  mass: number;
  mass_emitted?: number;
  mass_left?: number;
  energy: Record<string, number>;
  max_speed: number;
  volume_ratio?: {min: number; max: number};
  weak_fraction?: number;
  density?: {interior_nodes: number; mean: number; min: number; max: number; within_5_percent: number};
  [more: string]: unknown;
}

export interface Report {
  state: string;
  error: unknown;
  kernel_level: string;
  render_backend?: string;
  threads: number;
  steps: number;
  simulated_time: number;
  wall_seconds: number;
  render_seconds: number;
  point_steps_per_second: number;
  largest_cfl: number;
  time_step: {smallest: number; largest: number};
  stages: {name: string; seconds: number}[];
  frames: ReportFrame[];
  probes?: unknown[];
  warnings?: string[];
  [more: string]: unknown;
}

export interface SceneEntry {
  name: string;
  url: string;
  title?: string | null;
  dimension?: number | null;
  solver?: string | null;
  picture?: string | null;
}

export interface Schema {
  $ref?: string;
  $defs?: Record<string, Schema>;
  type?: string;
  const?: Json;
  enum?: Json[];
  oneOf?: Schema[];
  anyOf?: Schema[];
  properties?: Record<string, Schema>;
  required?: string[];
  additionalProperties?: boolean | Schema;
  items?: Schema | false;
  prefixItems?: Schema[];
  minItems?: number;
  maxItems?: number;
  minimum?: number;
  maximum?: number;
  exclusiveMinimum?: number;
  minLength?: number;
  maxLength?: number;
  description?: string;
  default?: Json;
  "x-unit"?: string;
}

export const isObject = (value: unknown): value is JsonObject =>
  typeof value === "object" && value !== null && !Array.isArray(value);
