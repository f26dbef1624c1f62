import { render } from 'preact';
import { useEffect, useMemo, useState } from 'preact/hooks';
import { Precipitation, Visibility, Wind, type Change } from './air';
import { Clock } from './clock';
import { Flight, LinkFacts, Plan } from './facts';
import { Layers } from './layers';
import { Link, type Heard } from './link';
import { Presets } from './presets';
import { Pictures, Preview } from './preview';
import { Report } from './report';
import './style.css';
import type { Send } from './types';
import { useRemembered } from './units';

function Lamp(props: { good: boolean; text: string }) {
  return <span class={props.good ? 'lamp good' : 'lamp bad'}>{props.text}</span>;
}

/** Whether this station's wishes count, in a word. */
function Lamps(props: { heard: Heard }) {
  const { heard } = props;
  const status = heard.status;
  if (!heard.open) return <Lamp good={false} text="no station" />;
  if (!status || status.silence !== '') return <Lamp good={false} text="no daemon" />;
  return (
    <>
      <Lamp good={status.health?.ok ?? false} text={status.health?.ok ? 'drawing' : (status.health?.text ?? 'unknown')} />
      <Lamp good={status.weather_shown} text={status.weather_shown ? 'weather shown' : 'weather on its way'} />
      <Lamp good={status.clock_shown} text={status.clock_shown ? 'time shown' : 'time on its way'} />
    </>
  );
}

function trouble(heard: Heard): string {
  const since = new Date(heard.since).toISOString().slice(11, 19);
  if (!heard.open) return `No connection since ${since} UTC: ${heard.trouble}.`;
  if (heard.status && heard.status.silence !== '')
    return `The daemon does not answer: ${heard.status.silence}. What is set here is said to it once it does.`;
  const standby = heard.status?.world?.mode === 'standby' && heard.status.sources?.some((s) => s.owns.includes('control'));
  if (standby && !(heard.status!.weather_shown && heard.status!.clock_shown))
    return 'The host keeps the daemon in Standby: what is set here is shown once it operates.';
  return heard.refused ?? '';
}

function App() {
  const [heard, setHeard] = useState<Heard>({ open: false, trouble: '', since: Date.now() });
  const [theme, setTheme] = useRemembered('theme', 'night');
  const pictures = useMemo(() => new Pictures(), []);
  const link = useMemo(() => new Link(setHeard, (channel, jpeg) => pictures.take(channel, jpeg)), []);
  useEffect(() => { document.documentElement.dataset.theme = theme; }, [theme]);
  const send: Send = (wish) => link.send(wish);
  const { state, status, hello } = heard;
  const change: Change = (what, apply, gesture) => {
    if (!state) return;
    const weather = structuredClone(state.weather);
    apply(weather);
    send({ do: 'weather', weather, what, gesture: gesture ?? '' });
  };
  const { unheard } = heard;
  const said = [trouble(heard), unheard ? `Perhaps not heard by the station: ${unheard}. Set it again where it is missing here.` : '']
    .filter((text) => text !== '').join(' ');
  const lively = heard.open && status?.silence === '';
  return (
    <>
      <header class="bar">
        <h1>skyig</h1>
        <div class="lamps" role="status"><Lamps heard={heard} /></div>
        <div class="acts">
          <button type="button" id="undo" disabled={!lively || !state?.undo} title={state?.undo ? `take back: ${state.undo}` : 'nothing to take back'}
            onClick={() => send({ do: 'undo' })}>Undo</button>
          <button type="button" id="redo" disabled={!lively || !state?.redo} title={state?.redo ? `again: ${state.redo}` : 'nothing taken back'}
            onClick={() => send({ do: 'redo' })}>Redo</button>
          <button type="button" id="clear" disabled={!lively} onClick={() => send({ do: 'preset', name: 'cavok' })}>CAVOK</button>
          <button type="button" id="theme" onClick={() => setTheme(theme === 'night' ? 'day' : 'night')}>
            {theme === 'night' ? 'Day' : 'Night'} theme</button>
        </div>
      </header>
      {said !== '' && (
        <div class="notice" role="alert"><p>{said}</p>
          {(unheard || heard.refused) && <button type="button" id="dismiss" onClick={() => link.dismiss()}>Dismiss</button>}
        </div>
      )}
      {state && status && hello && (
        <main class={lively ? '' : 'gone'} inert={!heard.open}>
          <div class="column">
            <Preview channels={status.channels ?? []} pictures={pictures} lively={lively} />
            <Presets hello={hello} state={state} send={send} />
            <LinkFacts status={status} />
          </div>
          <div class="column">
            <Layers state={state} status={status} change={change} />
            <Visibility state={state} change={change} send={send} />
            <Precipitation weather={state.weather} change={change} />
            <Wind air={state.weather.air} change={change} />
          </div>
          <div class="column">
            <Clock state={state} status={status} almanac={heard.almanac} fastest={hello.fastest} send={send} />
            <Report metar={heard.metar} send={send} />
            <Flight />
            <Plan status={status} />
          </div>
        </main>
      )}
    </>
  );
}

render(<App />, document.getElementById('app')!);
