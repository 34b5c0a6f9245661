// The rules of the page's sources: `npm run lint` asks for them, and a warning counts as an error.
import { dirname } from 'node:path';
import { fileURLToPath } from 'node:url';
import js from '@eslint/js';
import { defineConfig } from 'eslint/config';
import hooks from 'eslint-plugin-react-hooks';
import ts from 'typescript-eslint';

/** For every file: what holds in the whole tree. */
const house = {
  eqeqeq: ['error', 'smart'],
  // prettier breaks no comment and no text.
  'max-len': ['error', { code: 120, ignoreStrings: true, ignoreTemplateLiterals: true }],
  'max-lines-per-function': ['error', { max: 60 }],
  'no-console': 'error',
  'no-var': 'error',
  'object-shorthand': 'error',
  'prefer-const': 'error',
  'prefer-template': 'error',
};

const typed = {
  '@typescript-eslint/consistent-type-imports': 'error',
  '@typescript-eslint/explicit-function-return-type': ['error', { allowExpressions: true }],
  '@typescript-eslint/no-shadow': 'error',
  '@typescript-eslint/switch-exhaustiveness-check': 'error',

  // A handler in one line, `onClick={() => order('hold')}`, is not read for its value.
  '@typescript-eslint/no-confusing-void-expression': [
    'error',
    { ignoreArrowShorthand: true, ignoreVoidOperator: true },
  ],
  // Letters of axes are plain ASCII: the places in a string of them are the axes.
  '@typescript-eslint/no-misused-spread': ['error', { allow: ['string'] }],
  // One key is left out of an object by naming it beside the rest.
  '@typescript-eslint/no-unused-vars': ['error', { ignoreRestSiblings: true }],
  // An empty sentence is none: `why || undefined` and `mayOperate() || '...'` mean it.
  '@typescript-eslint/prefer-nullish-coalescing': ['error', { ignorePrimitives: { string: true } }],
  // Numbers and switches read well in a text.
  '@typescript-eslint/restrict-template-expressions': ['error', { allowBoolean: true, allowNumber: true }],
};

/** Of node, and of the page where a browser test looks into it. */
const names = (...all) => Object.fromEntries(all.map((name) => [name, 'readonly']));
const node = names('fetch', 'performance', 'process', 'setTimeout', 'URL');
const page = names('document', 'Event', 'getComputedStyle', 'innerWidth', 'localStorage', 'location', 'window');

export default defineConfig(
  { linterOptions: { reportUnusedDisableDirectives: 'error' } },
  js.configs.recommended,
  { rules: house },
  { files: ['test/**/*.mjs'], languageOptions: { globals: { ...node, ...page } } },
  { files: ['vite.config.ts'], extends: [ts.configs.strict], languageOptions: { globals: node } },
  {
    files: ['src/**/*.{ts,tsx}', 'test/unit/**/*.ts'],
    extends: [ts.configs.strictTypeChecked, ts.configs.stylisticTypeChecked],
    languageOptions: {
      parserOptions: { projectService: true, tsconfigRootDir: dirname(fileURLToPath(import.meta.url)) },
    },
    rules: typed,
  },
  {
    // Each test loads modules anew: their types are named by the module.
    files: ['test/unit/**/*.ts'],
    rules: { '@typescript-eslint/consistent-type-imports': ['error', { disallowTypeAnnotations: false }] },
  },
  {
    files: ['src/**/*.{ts,tsx}'],
    // preact's hooks have the rules of React's.
    plugins: { 'react-hooks': hooks },
    rules: { 'react-hooks/rules-of-hooks': 'error', 'react-hooks/exhaustive-deps': 'error' },
  },
);
