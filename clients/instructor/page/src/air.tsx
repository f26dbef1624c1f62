// Visibility, wind, temperature and what falls.
import { Card, Choice, NumberField, UnitChoice } from './controls';
import { kDistances, kSpeeds, shown, useUnit } from './units';
import type { Air, Layer, State, Weather } from './types';
import type { Send } from './types';

export type Change = (what: string, change: (weather: Weather) => void, gesture?: string) => void;

const kLeast = 50;
const kMost = 100000;
const kSteps = 100;

/** To hundredths at most and fortieths at least: less than half a step of the slider, which would stand still. */
function even(metres: number): number {
  const unit = 10 ** (Math.floor(Math.log10(metres / 2)) - 1);
  return Math.round(metres / unit) * unit;
}

export function Visibility(props: { state: State; change: Change; send: Send }) {
  const [unit, setUnit] = useUnit('visibility', kDistances, 'km');
  const { visibility_m } = props.state.weather.air;
  const fog = props.state.weather.layers.find((layer) => layer.type === 'fog' && layer.visibility_m > 0);
  const set = (metres: number, gesture?: string) =>
    props.change('visibility', (weather) => { weather.air.visibility_m = metres; }, gesture);
  const place = Math.log(Math.min(Math.max(visibility_m, kLeast), kMost) / kLeast) / Math.log(kMost / kLeast);
  return (
    <Card title="Visibility" id="visibility"
      aside={<UnitChoice label="visibility" units={kDistances} unit={unit} choose={setUnit} />}>
      <div class="row">
        <NumberField id="visibility" label="MOR" value={visibility_m} unit={unit} min={10} max={400000}
          step={unit.size === 1 ? 50 : 0.5} commit={(value) => set(value)} />
        <NumberField id="rvr" label="RVR, day lights" value={props.state.rvr_m ?? 0} unit={unit.name === 'ft' ? unit : kDistances[0]}
          min={10} max={10000} step={50} commit={(value) => props.send({ do: 'rvr', rvr_m: value })} />
      </div>
      <input class="slider" type="range" min={0} max={kSteps} value={Math.round(place * kSteps)}
        aria-label="visibility" aria-valuetext={`${shown(visibility_m, unit)} ${unit.name}`}
        onChange={(event) => set(even(kLeast * (kMost / kLeast) ** (Number(event.currentTarget.value) / kSteps)))} />
      {fog && <p class="quiet">Below {shown(fog.top_m, { name: 'ft', size: 0.3048, decimals: 0 })} ft there is fog of{' '}
        {shown(fog.visibility_m, unit)} {unit.name}.</p>}
    </Card>
  );
}

export function Wind(props: { air: Air; change: Change }) {
  const [unit, setUnit] = useUnit('wind', kSpeeds, 'kt');
  const set = (key: keyof Air, what: string) => (value: number) =>
    props.change(what, (weather) => { weather.air[key] = value; });
  return (
    <Card title="Wind and air" id="wind"
      aside={<UnitChoice label="wind" units={kSpeeds} unit={unit} choose={setUnit} />}>
      <div class="row">
        <NumberField id="wind-from" label="From" unitName="° true" value={props.air.wind_from_deg} min={0} max={360}
          step={10} commit={set('wind_from_deg', 'wind')} />
        <NumberField id="wind-speed" label="Speed" unit={unit} value={props.air.wind_m_s} min={0} max={60}
          commit={set('wind_m_s', 'wind')} />
        <NumberField id="temperature" label="Temperature" unitName="°C" decimals={1} value={props.air.temperature_c}
          min={-90} max={60} commit={set('temperature_c', 'temperature')} />
        <NumberField id="pressure" label="QNH" unitName="hPa" value={props.air.pressure_hpa} min={800} max={1100}
          commit={set('pressure_hpa', 'pressure')} />
        <NumberField id="humidity" label="Humidity" unitName="%" value={props.air.humidity_pct} min={0} max={100}
          commit={set('humidity_pct', 'humidity')} />
      </div>
    </Card>
  );
}

const kFalls = ['none', 'drizzle', 'rain', 'snow', 'sleet', 'hail'] as const;
/** Light, moderate, heavy, mm of water an hour: as weather reports mean them. */
const kRates: Record<string, [number, number, number]> = {
  drizzle: [0.2, 0.5, 1], rain: [1, 5, 15], snow: [0.5, 2, 4], sleet: [1, 5, 15], hail: [1, 5, 15],
};

function falls(layer: Layer): boolean {
  return layer.type in kRates;
}

/** It falls from the lowest cloud that covers more than half of the sky. */
function ceiling(weather: Weather): number {
  const bases = weather.layers.filter((layer) => layer.id !== undefined && layer.coverage > 0.5).map((l) => l.base_m);
  return bases.length > 0 ? Math.max(Math.min(...bases), 60) : 1500;
}

export function Precipitation(props: { weather: Weather; change: Change }) {
  const falling = props.weather.layers.find(falls);
  const type = (falling?.type ?? 'none') as (typeof kFalls)[number];
  const put = (kind: string, rate: number) =>
    props.change(kind === 'none' ? 'dry' : kind, (weather) => {
      const top = falling?.top_m ?? ceiling(weather);
      weather.layers = weather.layers.filter((layer) => !falls(layer));
      if (kind === 'none') return;
      weather.layers.push({ type: kind, base_m: -1000, top_m: top, bottom_band_m: 0, top_band_m: 0, coverage: 1,
        visibility_m: 0, rate_mm_h: rate, severity: 0, lightning: false });
    });
  const rates = kRates[type];
  return (
    <Card title="Precipitation" id="precipitation">
      <Choice label="precipitation" value={type} options={kFalls.map((kind) => ({ value: kind, text: kind }))}
        choose={(kind) => put(kind, kRates[kind]?.[1] ?? 0)} />
      {falling && rates && (
        <div class="row">
          <Choice label="how much" value={String(rates.indexOf(falling.rate_mm_h))}
            options={['light', 'moderate', 'heavy'].map((text, i) => ({ value: String(i), text }))}
            choose={(i) => put(type, rates[Number(i)]!)} />
          <NumberField id="rate" label="Rate" unitName="mm/h" decimals={1} value={falling.rate_mm_h} min={0.1} max={300}
            step={0.5} commit={(rate) => put(type, rate)} />
        </div>
      )}
    </Card>
  );
}
