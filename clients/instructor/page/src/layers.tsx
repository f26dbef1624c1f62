// Clouds and fog as a picture of the heights, to be dragged, and as a list.
import { useRef, useState } from 'preact/hooks';
import { Card, NumberField, UnitChoice } from './controls';
import { kHeights, shown, useUnit, type Unit } from './units';
import type { Change } from './air';
import type { Layer, State, Status } from './types';

const kClouds = ['cirrus', 'cirrostratus', 'cirrocumulus', 'altocumulus', 'altostratus', 'stratocumulus', 'stratus',
  'cumulus', 'nimbostratus', 'cumulonimbus'];
const kVeils = ['fog', 'haze', 'smoke', 'sand', 'dust'];
const kTop_m = 14000;
const kHigh = 300;
const kWide = 360;
const kThinnest_m = 15;
type Handle = 'base' | 'top' | 'both';

/** Low heights get more room. */
function y(height_m: number): number {
  return kHigh * (1 - Math.sqrt(Math.min(Math.max(height_m, 0), kTop_m) / kTop_m));
}
function height(at: number): number {
  return kTop_m * (1 - Math.min(Math.max(at, 0), kHigh) / kHigh) ** 2;
}
function rounded(height_m: number): number {
  const feet = height_m / 0.3048;
  const step = feet < 1000 ? 10 : feet < 10000 ? 100 : 500;
  return Math.round(feet / step) * step * 0.3048;
}

export function moved(layer: Layer, handle: Handle, by_m: number): Layer {
  const base_m = handle === 'top' ? layer.base_m : Math.max(rounded(layer.base_m + by_m), 0);
  const top_m = handle === 'base' ? layer.top_m
    : handle === 'both' ? base_m + layer.top_m - layer.base_m : rounded(layer.top_m + by_m);
  return handle === 'base'
    ? { ...layer, base_m: Math.min(base_m, layer.top_m - kThinnest_m) }
    : { ...layer, base_m, top_m: Math.max(top_m, base_m + kThinnest_m) };
}

let gestures = 0;

function Profile(props: { layers: Layer[]; unit: Unit; eye_m: number; change: Change }) {
  const picture = useRef<SVGSVGElement>(null);
  const [drag, setDrag] = useState<{ i: number; handle: Handle; from: number; start: Layer; now: Layer; name: string; sent: number } | null>(null);
  const where = (event: PointerEvent) => {
    const box = picture.current!.getBoundingClientRect();
    return ((event.clientY - box.top) / box.height) * kHigh;
  };
  const tell = (i: number, layer: Layer, gesture: string) =>
    props.change(`height of ${layer.type}`, (weather) => { weather.layers[i] = layer; }, gesture);
  const begin = (i: number, handle: Handle, event: PointerEvent) => {
    event.preventDefault();
    picture.current!.setPointerCapture(event.pointerId);
    const start = props.layers[i]!;
    gestures += 1;
    setDrag({ i, handle, from: where(event), start, now: start, name: `drag-${Date.now()}-${gestures}`, sent: 0 });
  };
  const follow = (event: PointerEvent) => {
    if (!drag) return;
    const edge = drag.handle === 'top' ? drag.start.top_m : drag.start.base_m;
    const by_m = height(y(edge) + where(event) - drag.from) - edge;
    const now = moved(drag.start, drag.handle, by_m);
    const due = Date.now() - drag.sent > 120;
    if (due) tell(drag.i, now, drag.name);
    setDrag({ ...drag, now, sent: due ? Date.now() : drag.sent });
  };
  const end = () => {
    if (drag) tell(drag.i, drag.now, drag.name);
    setDrag(null);
  };
  const marks = props.unit.name === 'ft' ? [0, 1000, 3000, 6000, 10000, 20000, 30000, 40000] : [0, 300, 1000, 2000, 4000, 7000, 10000, 13000];
  const column = props.layers.length > 0 ? (kWide - 60) / props.layers.length : 0;
  return (
    <svg ref={picture} class="profile" viewBox={`0 0 ${kWide} ${kHigh}`} role="group" aria-label="heights of the layers"
      onPointerMove={follow} onPointerUp={end} onPointerCancel={end}>
      {marks.map((mark) => (
        <g key={mark}>
          <line class="grid" x1={44} x2={kWide} y1={y(mark * props.unit.size)} y2={y(mark * props.unit.size)} />
          <text class="mark" x={40} y={Math.min(Math.max(y(mark * props.unit.size) + 4, 11), kHigh - 3)}>{mark}</text>
        </g>
      ))}
      {props.layers.map((told, i) => {
        const layer = drag?.i === i ? drag.now : told;
        const top = y(layer.top_m);
        const base = y(layer.base_m);
        const x = 52 + i * column;
        const wide = Math.max(column - 10, 30);
        const cover = layer.coverage * wide;
        const handle = (which: Handle, at: number, hx: number) => (
          <g class="handle" role="slider" tabindex={0} data-layer={i} data-handle={which}
            aria-label={`${which} of ${layer.type}`} aria-valuemin={0} aria-valuemax={kTop_m}
            aria-valuenow={Math.round(which === 'top' ? layer.top_m : layer.base_m)}
            aria-valuetext={`${shown(which === 'top' ? layer.top_m : layer.base_m, props.unit)} ${props.unit.name}`}
            onPointerDown={(event) => { event.stopPropagation(); begin(i, which, event); }}
            onKeyDown={(event) => {
              const turn = event.key === 'ArrowUp' ? 1 : event.key === 'ArrowDown' ? -1 : 0;
              if (turn === 0) return;
              event.preventDefault();
              tell(i, moved(layer, which, turn * 30.48), '');
            }}>
            <rect class="touch" x={hx - 24} y={at - 24} width={48} height={48} />
            <rect class="grip" x={hx - 11} y={at - 4} width={22} height={8} rx={4} />
          </g>
        );
        return (
          <g key={`${layer.type}-${layer.id}`} class={`layer ${layer.type} ${layer.type in { fog: 1, haze: 1 } ? 'veil' : ''}`}>
            <rect class="room" x={x} y={top} width={wide} height={Math.max(base - top, 2)}
              onPointerDown={(event) => begin(i, 'both', event)} />
            <rect class="cover" x={x} y={top} width={Math.max(cover, 2)} height={Math.max(base - top, 2)} />
            <text class="name" x={x + wide / 2} y={Math.max(top - 8, 12)}>{layer.type.slice(0, Math.max(Math.floor(wide / 7), 4))}</text>
            {drag?.i === i && (
              <text class="name" x={x + wide / 2} y={Math.min(base + 16, kHigh - 4)}>
                {shown(layer.base_m, props.unit)}–{shown(layer.top_m, props.unit)} {props.unit.name}
              </text>
            )}
            {handle('top', top, x + wide * 0.25)}
            {handle('base', base, x + wide * 0.75)}
          </g>
        );
      })}
      {props.eye_m >= 0 && props.eye_m < kTop_m && (
        <g class="eye"><line x1={44} x2={kWide} y1={y(props.eye_m)} y2={y(props.eye_m)} />
          <text x={kWide - 4} y={y(props.eye_m) - 4}>aircraft</text></g>
      )}
    </svg>
  );
}

function Row(props: { layer: Layer; i: number; unit: Unit; change: Change }) {
  const { layer, i, unit } = props;
  const cloud = kClouds.includes(layer.type);
  const set = (what: string, change: (layer: Layer) => void) =>
    props.change(`${what} of ${layer.type}`, (weather) => change(weather.layers[i]!));
  return (
    <li class="layer-row">
      <label class="field" for={`type-${i}`}><span>Type</span>
        <select id={`type-${i}`} value={layer.type} onChange={(event) => set('type', (l) => { l.type = event.currentTarget.value; })}>
          {(cloud ? kClouds : kVeils).map((type) => <option key={type} value={type}>{type}</option>)}
        </select>
      </label>
      {cloud
        ? <NumberField id={`oktas-${i}`} label="Cover" unitName="oktas" decimals={1} value={layer.coverage * 8} min={0} max={8}
            step={0.5} commit={(oktas) => set('cover', (l) => { l.coverage = oktas / 8; })} />
        : <NumberField id={`inside-${i}`} label="Visibility" unitName="m" value={layer.visibility_m} min={5} max={400000}
            step={50} commit={(metres) => set('visibility', (l) => { l.visibility_m = metres; })} />}
      <NumberField id={`base-${i}`} label="Base" unit={unit} value={Math.max(layer.base_m, 0)} min={0} max={layer.top_m - kThinnest_m}
        step={100} commit={(base) => set('base', (l) => { l.base_m = base; })} />
      <NumberField id={`top-${i}`} label="Top" unit={unit} value={layer.top_m} min={Math.max(layer.base_m, 0) + kThinnest_m} max={20000}
        step={100} commit={(top) => set('top', (l) => { l.top_m = top; })} />
      {cloud && <button type="button" aria-pressed={layer.lightning} title="lightning"
        onClick={() => set('lightning', (l) => { l.lightning = !l.lightning; })}>Lightning</button>}
      <button type="button" class="narrow" aria-label={`remove ${layer.type}`}
        onClick={() => props.change(`no ${layer.type}`, (weather) => { weather.layers.splice(i, 1); })}>×</button>
    </li>
  );
}

export function Layers(props: { state: State; status: Status; change: Change }) {
  const [unit, setUnit] = useUnit('height', kHeights, 'ft');
  const all = props.state.weather.layers;
  // What falls has a card of its own; places in the list of all are kept.
  const own = all.map((layer, i) => ({ layer, i })).filter(({ layer }) => kClouds.includes(layer.type) || kVeils.includes(layer.type));
  const change: Change = (what, apply, gesture) =>
    props.change(what, (weather) => {
      const some = { ...weather, layers: own.map(({ i }) => weather.layers[i]!) };
      apply(some);
      weather.layers = [...some.layers, ...weather.layers.filter((_, i) => !own.some((one) => one.i === i))];
    }, gesture);
  const add = (type: string) => {
    const [base_m, top_m] = type === 'fog' ? [-1000, 90] : type === 'cirrus' ? [8000, 9000] : type === 'altocumulus' ? [3000, 3600] : [1220, 1980];
    change(`new ${type}`, (weather) => weather.layers.push({ type, base_m, top_m, bottom_band_m: type === 'fog' ? 0 : 30,
      top_band_m: type === 'fog' ? 0 : 30, coverage: type === 'fog' ? 1 : 0.5, visibility_m: type === 'fog' ? 500 : 0,
      rate_mm_h: 0, severity: 0, lightning: false }));
  };
  const elevation = props.status.world?.weather.elevation_m ?? 0;
  return (
    <Card title="Clouds and fog" id="layers" aside={<UnitChoice label="heights" units={kHeights} unit={unit} choose={setUnit} />}>
      <Profile layers={own.map((one) => one.layer)} unit={unit} change={change}
        eye_m={(props.status.world?.ownship.height_m ?? -1) - elevation} />
      <ul class="layer-rows">
        {own.map(({ layer }, i) => <Row key={`${layer.type}-${layer.id}`} layer={layer} i={i} unit={unit} change={change} />)}
      </ul>
      <div class="row">
        {['cumulus', 'altocumulus', 'cirrus', 'fog'].map((type) => (
          <button type="button" key={type} disabled={type === 'fog' && own.some((one) => one.layer.type === 'fog')}
            onClick={() => add(type)}>+ {type}</button>
        ))}
      </div>
      <p class="quiet">Heights above the site, {shown(elevation, unit)} {unit.name} up.</p>
    </Card>
  );
}
