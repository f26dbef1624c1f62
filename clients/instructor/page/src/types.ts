// What the station tells, and what it is told: docs/instructor.md.
export interface Air {
  visibility_m: number;
  temperature_c: number;
  pressure_hpa: number;
  humidity_pct: number;
  wind_m_s: number;
  wind_from_deg: number;
}

/** Heights above the site's elevation. */
export interface Layer {
  type: string;
  id?: number;
  base_m: number;
  top_m: number;
  bottom_band_m: number;
  top_band_m: number;
  /** 0..1 */
  coverage: number;
  /** 0: as its kind has it. */
  visibility_m: number;
  rate_mm_h: number;
  severity: number;
  lightning: boolean;
}

export interface Weather {
  air: Air;
  layers: Layer[];
  snow_pct: number;
}

export interface State {
  weather: Weather;
  preset: string;
  rvr_m: number | null;
  clock: { running: boolean; speed: number; asked: boolean };
  undo: string | null;
  redo: string | null;
  saved: string[];
}

export interface Source {
  name: string;
  kind: string;
  link: string;
  owns: string[];
  holds: string[];
  silent_s: number | null;
}

export interface Status {
  /** Why the daemon says nothing; empty while it does. */
  silence: string;
  utc: string;
  clock_shown: boolean;
  weather_shown: boolean;
  said_again: number;
  port: Record<string, number>;
  version?: string;
  renderer?: string;
  rate_hz?: number;
  frames?: number;
  late_frames?: number;
  uptime_s?: number;
  recent?: { frames: number; late: number; rate_hz: number; median_ms: number; p95_ms: number; largest_ms: number };
  times?: { name: string; median_ms: number; p95_ms: number; largest_ms: number }[];
  health?: { ok: boolean; text: string };
  host?: { address: string; protocol: string; losses: number; frames_behind_median: number };
  channels?: string[];
  world?: {
    mode: string;
    utc: string;
    clock_running: boolean;
    ownship: { latitude_deg: number; longitude_deg: number; height_m: number; yaw_deg: number };
    weather: { elevation_m: number; transition_s: number };
    sun: { elevation_deg: number; azimuth_deg: number };
    moon: { elevation_deg: number; azimuth_deg: number; lit_fraction: number };
    adaptation_cd_m2: number;
  };
  sources?: Source[];
  plan?: { pass: string; needed: boolean; reason: string }[];
}

export interface Hello {
  presets: { name: string; title: string }[];
  layer_types: string[];
  fastest: number;
}

export interface Almanac {
  date: string;
  latitude_deg: number;
  longitude_deg: number;
  solar_h: number;
  step_min: number;
  events: { utc: string; body: string; kind: string }[];
  sun: number[];
  moon: number[];
}

export interface Metar {
  page: string;
  problems: string;
  applied: boolean;
}

export type Wish = Record<string, unknown> & { do: string };
export type Send = (wish: Wish) => void;
