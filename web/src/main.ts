import '../style/tokens.css';
import '../style/layout.css';
import '../style/controls.css';
import '../style/forms.css';
import '../style/stage.css';
import '../style/picture_tools.css';
import '../style/panels.css';
import '../style/inside.css';
import { App } from './app/app.ts';
import { corePool } from './stage/core_pool.ts';

// Worker, core and drawing code are on their way while the page is built.
corePool().warm();
void import('./viewport/viewport.ts').catch(() => undefined); // told by the picture, which asks again

const root = document.getElementById('app');
if (root) new App().mount(root);
