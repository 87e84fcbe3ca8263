import '../style/tokens.css';
import '../style/layout.css';
import '../style/controls.css';
import '../style/stage.css';
import '../style/panels.css';
import '../style/inside.css';
import { App } from './app/app.ts';

const root = document.getElementById('app');
if (root) new App().mount(root);
