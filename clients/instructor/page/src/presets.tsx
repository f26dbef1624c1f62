// Ready-made weather, and the instructor's own.
import { useState } from 'preact/hooks';
import { Card } from './controls';
import type { Hello, Send, State } from './types';

const kNames: Record<string, string> = {
  cavok: 'CAVOK', few: 'Few', scattered: 'Scattered', broken: 'Broken', overcast: 'Overcast', mvfr: 'Marginal VFR',
  rain: 'Rain', snow: 'Snow', storm: 'Storm', cat1: 'CAT I', cat2: 'CAT II', 'patchy-fog': 'Patchy fog', fog: 'Fog',
  cat3a: 'CAT IIIA', cat3b: 'CAT IIIB',
};

export function Presets(props: { hello: Hello; state: State; send: Send }) {
  const [name, setName] = useState('');
  const save = () => {
    if (name.trim() === '') return;
    props.send({ do: 'save', name: name.trim() });
    setName('');
  };
  return (
    <Card title="Presets" id="presets">
      <div class="presets">
        {props.hello.presets.map((preset) => (
          <button type="button" key={preset.name} data-preset={preset.name} title={preset.title}
            aria-pressed={props.state.preset === preset.name}
            onClick={() => props.send({ do: 'preset', name: preset.name })}>
            {kNames[preset.name] ?? preset.name}
          </button>
        ))}
      </div>
      <div class="own">
        {props.state.saved.map((saved) => (
          <span class="pair" key={saved}>
            <button type="button" onClick={() => props.send({ do: 'recall', name: saved })}>{saved}</button>
            <button type="button" class="narrow" aria-label={`remove own preset ${saved}`}
              onClick={() => props.send({ do: 'forget', name: saved })}>×</button>
          </span>
        ))}
        <span class="pair grow">
          <input aria-label="name of a new own preset" placeholder="Name this weather" maxLength={48} value={name}
            onInput={(event) => setName(event.currentTarget.value)}
            onKeyDown={(event) => event.key === 'Enter' && save()} />
          <button type="button" disabled={name.trim() === ''} onClick={save}>Save</button>
        </span>
      </div>
    </Card>
  );
}
