// The one WebSocket to the station: opened again whenever it is lost.
import type { Almanac, Hello, Metar, State, Status, Wish } from './types';

export interface Heard {
  open: boolean;
  /** Why there is no connection. */
  trouble: string;
  since: number;
  hello?: Hello;
  state?: State;
  status?: Status;
  almanac?: Almanac;
  metar?: Metar;
  refused?: string;
}

const kAgainMs = 1000;

/** From "#token=...", kept for this tab alone and out of the address. */
function token(): string {
  const given = new URLSearchParams(location.hash.slice(1)).get('token');
  if (given !== null) {
    sessionStorage.setItem('token', given);
    history.replaceState(null, '', location.pathname);
  }
  return sessionStorage.getItem('token') ?? '';
}

export class Link {
  private socket?: WebSocket;
  private heard: Heard = { open: false, trouble: 'connecting', since: Date.now() };

  constructor(
    private readonly changed: (heard: Heard) => void,
    private readonly picture: (channel: string, jpeg: Blob) => void,
  ) {
    this.connect();
  }

  send(wish: Wish): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(wish));
  }

  dismiss(): void {
    this.tell({ refused: undefined });
  }

  private tell(news: Partial<Heard>): void {
    this.heard = { ...this.heard, ...news };
    this.changed(this.heard);
  }

  private connect(): void {
    const word = token();
    const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
    const query = word === '' ? '' : `?token=${encodeURIComponent(word)}`;
    const socket = new WebSocket(`${scheme}://${location.host}/ws${query}`);
    let opened = false;
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      opened = true;
      this.tell({ open: true, trouble: '', since: Date.now() });
    };
    socket.onmessage = (event) => this.take(event.data);
    socket.onclose = () => {
      const trouble = opened || this.heard.hello
        ? 'the station does not answer'
        : 'the station does not let this page in: is it running, and is its token in the address (#token=...)?';
      if (this.heard.open) this.tell({ open: false, trouble, since: Date.now() });
      else this.tell({ trouble });
      setTimeout(() => this.connect(), kAgainMs);
    };
    this.socket = socket;
  }

  private take(data: string | ArrayBuffer): void {
    if (typeof data !== 'string') {
      const bytes = new Uint8Array(data);
      const length = bytes[0] ?? 0;
      const channel = new TextDecoder().decode(bytes.subarray(1, 1 + length));
      this.picture(channel, new Blob([bytes.subarray(1 + length)], { type: 'image/jpeg' }));
      return;
    }
    const message = JSON.parse(data);
    switch (message.type) {
      case 'hello': return this.tell({ hello: message });
      case 'state': return this.tell({ state: message, refused: undefined });
      case 'status': return this.tell({ status: message });
      case 'almanac': return this.tell({ almanac: message });
      case 'metar': return this.tell({ metar: message });
      case 'refused': return this.tell({ refused: message.text });
    }
  }
}
