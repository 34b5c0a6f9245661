// A stand-in for the program: speaks the panel's contract, moves its axes along a circle, notes every order with its time.
import { createServer } from 'node:http';
import { readFile } from 'node:fs/promises';
import { extname, join, normalize } from 'node:path';
import { WebSocketServer } from 'ws';

const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.svg': 'image/svg+xml', '.woff2': 'font/woff2' };
export const POLICY = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; font-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

const axis = (letter, unit, max) => ({ letter, unit, trusted: letter !== 'A', can_home: letter !== 'A', commanded: 0, actual: 0, error: 0, speed: 0, pulses: 0, counts: 0, min: 0, max, max_speed: letter === 'A' ? 180 : 100,
  leds: { soft_minus: false, soft_plus: false, hard_minus: false, hard_plus: false, home: false, index: false, in_position: true, alarm: false } });

export class Fake {
  orders = [];
  stops = 0;
  holder = null;
  role = 'maintain';
  mute = false;
  events = [];
  connections = new Map();
  status = {
    at: 0, sequence: 0, state: 'standstill', why: '', simulation: true, clock: { mode: 'real', factor: 1, late_ms: 0.2 }, estop: { wired: true, pressed: false },
    axes: [axis('X', 'mm', 300), axis('Y', 'mm', 200), axis('Z', 'mm', 100), axis('A', 'deg', 360)],
    program: { name: '', runs: false, line: 0, lines: 0, remaining_s: null, single_step: false }, overrides: { feed: 1, rapid: 1 }, alarms: [], homing: null, link: { sender: 'none', clients: 1 },
  };

  async start(folder) {
    this.http = createServer((request, response) => this.serve(folder, request, response));
    this.sockets = new WebSocketServer({ server: this.http, path: '/api/stream' });
    this.sockets.on('connection', (socket) => this.connected(socket));
    await new Promise((done) => this.http.listen(0, '127.0.0.1', done));
    this.address = `http://127.0.0.1:${this.http.address().port}/`;
    this.timer = setInterval(() => this.tick(), 50);
    return this;
  }

  async stop() {
    clearInterval(this.timer);
    for (const socket of this.sockets.clients) socket.terminate();
    await new Promise((done) => this.http.close(done));
  }

  async serve(folder, request, response) {
    const path = new URL(request.url, 'http://x').pathname;
    const head = { 'content-security-policy': POLICY, 'x-content-type-options': 'nosniff' };
    if (path === '/api/stop') {
      this.stops += 1;
      this.status.state = 'stopping';
      setTimeout(() => (this.status.state = 'standstill'), 100);
      return response.writeHead(200, head).end('{"done":true}');
    }
    if (path === '/api/pair') {
      let body = '';
      for await (const part of request) body += part;
      const good = JSON.parse(body).code === 'ABCD-EFGH';
      const answer = good ? { token: 'secret', role: 'maintain', user: JSON.parse(body).name, expires: 0 } : { error: { trouble: 'denied', message: 'This pairing code is not known. The browser is not paired; look at the code that the program printed.' } };
      return response.writeHead(good ? 200 : 403, { ...head, 'content-type': 'application/json' }).end(JSON.stringify(answer));
    }
    try {
      const file = normalize(path === '/' ? '/index.html' : path);
      const bytes = await readFile(join(folder, file));
      response.writeHead(200, { ...head, 'content-type': TYPES[extname(file)] ?? 'application/octet-stream' }).end(bytes);
    } catch {
      response.writeHead(404, head).end('not found');
    }
  }

  connected(socket) {
    const one = { session: `s${this.connections.size + 1}`, channels: [], seq: 0, role: this.role, user: '' };
    this.connections.set(socket, one);
    const send = (message) => socket.readyState === 1 && socket.send(JSON.stringify(message));
    send({ hello: { version: '0.1.0', rack: 'demonstration', boot: 'f3a1', role: this.role, simulation: true, session: one.session } });
    socket.on('message', (data) => {
      const message = JSON.parse(data.toString());
      if (this.mute) return;
      const reply = this.answer(one, message);
      send(reply.error ? { id: message.id, error: reply.error } : { id: message.id, done: true, ...reply });
    });
    socket.on('close', () => {
      if (this.holder === one.session) this.holder = null;
      this.connections.delete(socket);
    });
  }

  answer(one, message) {
    if (message.token) return message.token === 'secret' ? ((one.role = 'maintain'), (one.user = 'anna'), { role: 'maintain', user: 'anna' }) : { error: { trouble: 'denied', message: 'The token is not known.' } };
    if (message.subscribe) return (one.channels = message.subscribe.channels), {};
    if (message.query) return this.query(message);
    this.orders.push({ at: performance.now(), ...message });
    return this.order(one, message);
  }

  order(one, { order, ...fields }) {
    const s = this.status;
    const refuse = (message) => ({ error: { trouble: 'refused', message } });
    if (order === 'take_control') return this.holder && this.holder !== one.session && s.state !== 'standstill' ? refuse('anna holds control and the machine moves.') : ((this.holder = one.session), {});
    if (order === 'release_control') return (this.holder = null), {};
    if (order === 'enable') s.state = fields.on ? 'standstill' : 'disabled';
    if (order === 'jog') (s.state = 'jogging'), (this.jogged = performance.now());
    if (order === 'jog_stop' || order === 'stop' || order === 'reset') (s.state = 'standstill'), (s.program.runs = false);
    if (order === 'begin') (s.state = 'moving'), (s.program = { ...s.program, name: fields.name, runs: true, line: 1, lines: fields.text.split('\n').length, remaining_s: 83.2 });
    if (order === 'hold') {
      if (s.state !== 'moving') return refuse(`There is nothing to hold: the machine is in state '${s.state}'. Nothing was changed.`);
      s.state = 'hold';
    }
    if (order === 'resume') s.state = 'moving';
    if (order === 'set_overrides') Object.assign(s.overrides, fields);
    if (order === 'set_single_step') s.program.single_step = fields.on;
    if (order === 'press_estop') s.estop.pressed = fields.pressed;
    if (order === 'set_clock') s.clock = { ...s.clock, ...fields };
    if (order === 'acknowledge') s.alarms.forEach((alarm) => alarm.number === fields.alarm && (alarm.acknowledged = true));
    if (order === 'line' && /G999/.test(fields.text)) return { error: { trouble: 'bad_input', message: 'G999 is not a code that is understood.', line: 1, column: 1 } };
    if (order === 'check') return { good: true, lines: 4, seconds: 83.2, path_mm: 440, extents: { X: [10, 120], Y: [20, 130] }, problems: [], path: { axes: 'XYZA', points: [[10, 20, 0, 0], [120, 20, 0, 0], [120, 130, 0, 0], [10, 130, 0, 0], [10, 20, 0, 0]] } };
    if (order === 'invite') return { code: 'WXYZ-1234' };
    return {};
  }

  query({ query, ...fields }) {
    if (query === 'rack') return RACK;
    if (query === 'channels') return { channels: ['X', 'Y', 'Z', 'A'].flatMap((l) => ['commanded', 'actual', 'error', 'speed'].map((n) => ({ name: `${l}.${n}`, unit: n === 'speed' ? 'mm/s' : 'mm', text: n }))).concat(['x', 'y', 'z', 'u'].flatMap((c) => ['LP', 'EP', 'CV', 'CA'].map((n) => ({ name: `motion.${c}.${n}`, unit: '', text: n })))) };
    if (query === 'events') return { events: this.events };
    if (query === 'card') return { registers: [{ name: 'RR0', register: 'RR0', word: 0x0003 }, { name: 'x.RR1', register: 'RR1', word: 0x0411 }], values: { 'x.LP': 123456 }, numbers: {}, pins: {} };
    if (query === 'path' || query === 'scope') return {};
    return { error: { trouble: 'bad_input', message: `There is no query "${query}" (${Object.keys(fields).join()}).` } };
  }

  alarm(text) {
    this.status.alarms.push({ number: this.status.alarms.length + 1, at: this.status.at, text, source: 'machine', active: true, acknowledged: false });
    this.event('alarm', text);
  }

  event(kind, text) {
    const event = { number: this.events.length + 1, at: this.status.at, kind, text, data: {} };
    this.events.push(event);
    for (const socket of this.connections.keys()) socket.send(JSON.stringify({ event }));
  }

  tick() {
    const s = this.status;
    s.at += 0.05;
    s.sequence += 1;
    if (s.state === 'jogging' && performance.now() - this.jogged > 250) s.state = 'standstill';
    if (s.state === 'moving') {
      const [x, y] = [150 + 80 * Math.cos(s.at), 100 + 60 * Math.sin(2 * s.at)];
      [x, y].forEach((place, i) => Object.assign(s.axes[i], { commanded: place, actual: place - 0.004 * Math.sin(9 * s.at), error: 0.004 * Math.sin(9 * s.at), speed: 34.5 }));
      s.program.line = Math.min(s.program.lines, s.program.line + 1);
    }
    if (this.mute) return;
    for (const [socket, one] of this.connections) {
      const control = this.holder === null ? { holder: '' } : { holder: one.user || 'anna', holder_session: this.holder, since: 1 };
      const values = one.channels.map((_, i) => Math.round(1000 * Math.sin(s.at + i)));
      socket.send(JSON.stringify({ seq: (one.seq += 1), lost: 0, at: s.at, status: { ...s, control }, values }));
    }
  }
}

const RACK = {
  name: 'demonstration',
  axes: ['X', 'Y', 'Z', 'A'].map((letter, i) => ({ letter, unit: letter === 'A' ? 'deg' : 'mm', card: 'motion', channel: 'xyzu'[i] })),
  cards: [{ name: 'motion', type: 'mcx314', title: 'four-axis pulse chip with interpolation', slot: 0, about: '', bus: { base: 0, widths: [16] }, axes: ['X', 'Y', 'Z', 'A'].map((letter, i) => ({ letter, channel: 'xyzu'[i] })),
    registers: [{ name: 'RR0', offset: 0, width: 16, access: 'read', meaning: 'main status', fields: [{ name: 'XDRV', low: 0, bits: 1, meaning: 'X drives' }, { name: 'YDRV', low: 1, bits: 1, meaning: 'Y drives' }, { name: 'ZONE', low: 10, bits: 3, meaning: 'quadrant of the arc' }] },
      { name: 'RR1', offset: 2, width: 16, access: 'read', meaning: 'status of an axis', per_axis: true, fields: [{ name: 'CMPP', low: 0, bits: 1, meaning: 'at or above COMP+' }] }],
    commands: [], machines: [], pins: [], values: [], numbers: [] }],
  wires: [{ name: 'X.limit_plus', volts: false, bits: 1, drivable: true }, { name: 'estop', volts: false, bits: 1, drivable: true }],
  stages: [], tracks: [], scanners: [], faults: [{ target: 'X', faults: ['encoder.broken_a', 'motor.lose_steps'] }],
};

if (process.argv[1] === import.meta.filename || process.argv[1]?.endsWith('fake_server.mjs')) {
  const fake = await new Fake().start(process.argv[2]);
  process.stdout.write(`${fake.address}\n`);
}
