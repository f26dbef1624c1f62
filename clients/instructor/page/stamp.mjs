// Writes what the built files were made of, for the test that holds them against their sources.
import { createHash } from 'node:crypto';
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';

const sources = [
  'index.html', 'package-lock.json', 'package.json', 'tsconfig.json', 'vite.config.js',
  ...readdirSync('src').sort().map((name) => `src/${name}`),
].map((name) => `page/${name}`);
const built = ['app.css', 'app.js', 'index.html'].map((name) => `built/${name}`);
const line = (name) => `${createHash('sha256').update(readFileSync(`../${name}`)).digest('hex')}  ${name}\n`;
writeFileSync('../built/SHA256SUMS', [...sources, ...built].map(line).join(''));
