// The one WebSocket to the station: opened again whenever it is lost, or silent.
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
  /** What was asked for when the connection was lost or gone: nobody knows whether it was heard. */
  unheard?: string;
}

const kAgainMs = 1000;
/** The station speaks twice a second, and a network that is gone tells nobody. */
const kSilentMs = 5000;

/** From "#token=...", kept for this tab alone and out of the address. */
function token(): string {
  const given = new URLSearchParams(location.hash.slice(1)).get('token');
  if (given !== null) {
    sessionStorage.setItem('token', given);
    history.replaceState(null, '', location.pathname);
  }
  return sessionStorage.getItem('token') ?? '';
}

/** In the words of the page. */
function named(wish: Wish): string {
  return String(wish.what ?? [wish.do, wish.name].filter((word) => word !== undefined).join(' '));
}

export class Link {
  private socket?: WebSocket;
  private heard: Heard = { open: false, trouble: 'connecting', since: Date.now() };
  /** When the station last said something, or was called. */
  private spoke = Date.now();
  private unanswered?: string;

  constructor(
    private readonly changed: (heard: Heard) => void,
    private readonly picture: (channel: string, jpeg: Blob) => void,
  ) {
    this.connect();
    setInterval(() => { if (Date.now() - this.spoke > kSilentMs) this.lose(); }, kAgainMs);
  }

  send(wish: Wish): void {
    if (this.socket?.readyState !== WebSocket.OPEN) return this.tell({ unheard: named(wish) });
    this.unanswered = named(wish);
    this.socket.send(JSON.stringify(wish));
  }

  dismiss(): void {
    this.tell({ refused: undefined, unheard: undefined });
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
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => this.tell({ open: true, trouble: '', since: Date.now() });
    socket.onmessage = (event) => this.take(event.data);
    socket.onclose = () => this.lose();
    this.socket = socket;
    this.spoke = Date.now();
  }

  /** It is not waited for: over a network that is gone, a WebSocket takes minutes to close. */
  private lose(): void {
    const { socket } = this;
    if (!socket) return;
    this.socket = undefined;
    socket.onopen = socket.onmessage = socket.onclose = null;
    socket.close();
    const trouble = this.heard.hello
      ? 'the station does not answer'
      : 'the station does not let this page in: is it running, is its token in the address (#token=...), are fewer than 64 pages open?';
    const news = { trouble, unheard: this.unanswered ?? this.heard.unheard };
    this.unanswered = undefined;
    this.tell(this.heard.open ? { ...news, open: false, since: Date.now() } : news);
    setTimeout(() => this.connect(), kAgainMs);
  }

  private take(data: string | ArrayBuffer): void {
    this.spoke = Date.now();
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
      case 'state': return this.answered({ state: message, refused: undefined });
      case 'status': return this.tell({ status: message });
      case 'almanac': return this.tell({ almanac: message });
      case 'metar': return this.answered({ metar: message });
      case 'refused': return this.answered({ refused: message.text });
    }
  }

  private answered(news: Partial<Heard>): void {
    // What a new connection is greeted with answers nothing.
    if (this.unanswered !== undefined) news = { ...news, unheard: undefined };
    this.unanswered = undefined;
    this.tell(news);
  }
}
