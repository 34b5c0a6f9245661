// ESLint rules of the page's sources, checked by `npm run lint`; a warning counts as an error.
import { dirname } from 'node:path';
import { fileURLToPath } from 'node:url';
import js from '@eslint/js';
import { defineConfig } from 'eslint/config';
import hooks from 'eslint-plugin-react-hooks';
import ts from 'typescript-eslint';

/** Rules for every file. */
const house = {
  eqeqeq: ['error', 'smart'],
  // prettier does not wrap comments and strings.
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

  // Allows handlers in one line, `onClick={() => order('hold')}`, whose value is not used.
  '@typescript-eslint/no-confusing-void-expression': [
    'error',
    { ignoreArrowShorthand: true, ignoreVoidOperator: true },
  ],
  // Allows spreading strings of axis letters, which are ASCII: each character is an axis.
  '@typescript-eslint/no-misused-spread': ['error', { allow: ['string'] }],
  // Allows omitting a key from an object by naming it next to the rest.
  '@typescript-eslint/no-unused-vars': ['error', { ignoreRestSiblings: true }],
  // Allows `why || undefined` and `mayOperate() || '...'`, where an empty sentence means none.
  '@typescript-eslint/prefer-nullish-coalescing': ['error', { ignorePrimitives: { string: true } }],
  // Allows numbers and booleans in template strings.
  '@typescript-eslint/restrict-template-expressions': ['error', { allowBoolean: true, allowNumber: true }],
};

/** Globals of node, and of the page for browser tests that run code in it. */
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
    // Each test imports modules dynamically, so their types are named by import().
    files: ['test/unit/**/*.ts'],
    rules: { '@typescript-eslint/consistent-type-imports': ['error', { disallowTypeAnnotations: false }] },
  },
  {
    files: ['src/**/*.{ts,tsx}'],
    // The rules of React's hooks also apply to preact's.
    plugins: { 'react-hooks': hooks },
    rules: { 'react-hooks/rules-of-hooks': 'error', 'react-hooks/exhaustive-deps': 'error' },
  },
);
