// Writes licences.txt, the licences of all parts bundled into the page. A part without a licence text makes the build
// fail.
import { existsSync, readdirSync, readFileSync } from 'node:fs';

const read = (path) => readFileSync(path, 'utf8');

/** All dependencies of package.json; fonts come by style sheets, which the bundler does not list as modules. */
const wanted = () => Object.keys(JSON.parse(read('package.json')).dependencies);

/** Package of a module: `@preact/signals` for `/x/node_modules/@preact/signals/dist/a.mjs`, `vite` for `\0vite/..`. */
function packageOf(id) {
  if (id.startsWith('\0vite/')) return 'vite';
  const parts = id.split('/node_modules/');
  if (parts.length < 2) return undefined;
  const names = parts[parts.length - 1].split('/');
  return names[0].startsWith('@') ? `${names[0]}/${names[1]}` : names[0];
}

function licenceOf(name) {
  const folder = `node_modules/${name}`;
  const file = existsSync(folder) && readdirSync(folder).find((each) => /^licen[cs]e(\.(md|txt))?$/i.test(each));
  if (!file)
    throw new Error(`${folder} has no file with its licence: the page must not have it. Choose another package.`);
  // The rest of Vite's file has the licences of its own dependencies, which are not part of the page.
  return read(`${folder}/${file}`).split('# Licenses of bundled dependencies')[0].trim();
}

export function licences() {
  return {
    name: 'licences',
    generateBundle() {
      const names = new Set(wanted());
      for (const id of this.getModuleIds()) if (packageOf(id)) names.add(packageOf(id));
      const texts = [...names].sort().map((name) => {
        const { version, license } = JSON.parse(read(`node_modules/${name}/package.json`));
        return `==== ${name} ${version}, ${license} ====\n\n${licenceOf(name)}\n`;
      });
      const source = `This page has parts of others, under these licences.\n\n${texts.join('\n\n')}`;
      this.emitFile({ type: 'asset', fileName: 'licences.txt', source });
    },
  };
}
