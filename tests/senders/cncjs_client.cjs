// Plays the operator of cncjs through its socket.io API: unlock, home, $$, a program with a hold, a jog that is cancelled, a reset.
// node cncjs_client.cjs NODE_MODULES PORT TERMINAL PROGRAM; prints a line for what it has seen, ends with 1 at what did not come.
const [modules, port, terminal, part] = process.argv.slice(2);
const io = require(`${modules}/socket.io-client`);
const fs = require('fs');

const seen = {state: '', text: '', sent: 0, workflow: ''};
const wait = (ms) => new Promise((done) => setTimeout(done, ms));
async function until(what, test, seconds = 60) {
  const end = Date.now() + seconds * 1000;
  while (!test()) {
    if (Date.now() > end) throw new Error(`${what}: not within ${seconds} s; state ${seen.state}, workflow ${seen.workflow}, heard ${JSON.stringify(seen.text.slice(-300))}`);
    await wait(20);
  }
  console.log(what);
}

async function main() {
  const answer = await fetch(`http://127.0.0.1:${port}/api/signin`, {method: 'POST', headers: {'Content-Type': 'application/json'}, body: '{}'});
  const {token} = await answer.json();
  const socket = io(`http://127.0.0.1:${port}`, {query: `token=${token}`, transports: ['websocket']});
  let open = false;
  socket.on('serialport:open', () => { open = true; });
  socket.on('serialport:read', (text) => { seen.text += text + '\n'; });
  socket.on('controller:state', (type, state) => { if (state && state.status) seen.state = state.status.activeState; });
  socket.on('sender:status', (status) => { seen.sent = status.received; });
  socket.on('workflow:state', (state) => { seen.workflow = state; });
  await until('connected', () => socket.connected);
  socket.emit('open', terminal, {controllerType: 'Grbl', baudrate: 115200, rtscts: false});
  await until('port opened', () => open);
  await until('locked at first', () => seen.state === 'Alarm');
  const command = (...words) => socket.emit('command', terminal, ...words);
  const write = (text) => socket.emit('write', terminal, text);

  command('unlock');
  await until('unlocked', () => seen.state === 'Idle');
  command('homing');
  await until('homing', () => seen.state === 'Home');
  await until('homed', () => seen.state === 'Idle', 120);
  write('$$\n');
  await until('settings read', () => seen.text.includes('$130=300.000'));

  command('gcode:load', 'part.nc', fs.readFileSync(part, 'utf8'));
  await wait(300);
  command('gcode:start');
  await until('program runs', () => seen.state === 'Run' && seen.workflow === 'running');
  await wait(1000);
  command('feedhold');
  await until('held', () => seen.state === 'Hold');
  await wait(500);
  command('cyclestart');
  await until('resumed', () => seen.state === 'Run');
  await until('program done', () => seen.state === 'Idle' && seen.workflow === 'idle', 90);

  command('gcode', '$J=G91 X100 F600');
  await until('jogs', () => seen.state === 'Jog');
  command('jogCancel');
  await until('jog cancelled', () => seen.state === 'Idle', 20);
  command('gcode', 'G91 G1 X100 F600');  // 10 s, so that the reset finds it moving
  await until('runs a line', () => seen.state === 'Run');
  command('reset');
  await until('reset in motion', () => seen.text.includes('ALARM:3') && seen.state === 'Alarm');
  socket.emit('close', terminal);
  await wait(200);
  process.exit(0);
}

main().catch((error) => {
  console.log(`failed: ${error.message}`);
  process.exit(1);
});
