// Path in space, loaded on demand. Dragging rotates, the wheel and + − zoom, arrows rotate.
import { effect } from '@preact/signals';
import type { JSX } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  EdgesGeometry,
  Line,
  LineBasicMaterial,
  LineDashedMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  PerspectiveCamera,
  Scene,
  SphereGeometry,
  Vector3,
  WebGLRenderer,
} from 'three';
import * as state from '../link/state';
import { dark } from '../view';
import { errorColour } from './colours';
import { driven, maxError, planned } from './data';
import { KEY_TURNS, turned, type Eye, type Turn } from './eye';

function geometry(points: readonly number[][]): BufferGeometry {
  const flat = new Float32Array(points.length * 3);
  points.forEach((point, i) => flat.set([point[0] ?? 0, point[1] ?? 0, point[2] ?? 0], i * 3));
  return new BufferGeometry().setAttribute('position', new BufferAttribute(flat, 3));
}

class View {
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(40, 1, 0.1, 1e5);
  private readonly renderer: WebGLRenderer;
  private readonly box: LineSegments<EdgesGeometry, LineDashedMaterial>;
  private readonly plan = new Line(new BufferGeometry(), new LineBasicMaterial());
  private readonly real = new Line(new BufferGeometry(), new LineBasicMaterial({ vertexColors: true }));
  private readonly tool: Mesh<SphereGeometry, MeshBasicMaterial>;
  private readonly middle = new Vector3();
  eye: Eye = { turn: -0.9, tilt: 0.6, far: 1 };
  private wanted = false;

  constructor(private readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    const size = new Vector3(1, 1, 1);
    state.axes
      .peek()
      .slice(0, 3)
      .forEach((axis, i) => {
        size.setComponent(i, axis.max - axis.min);
        this.middle.setComponent(i, (axis.max + axis.min) / 2);
      });
    this.box = new LineSegments(
      new EdgesGeometry(new BoxGeometry(size.x, size.y, size.z)),
      new LineDashedMaterial({ dashSize: 4, gapSize: 3 }),
    );
    this.box.computeLineDistances();
    this.box.position.copy(this.middle);
    this.tool = new Mesh(new SphereGeometry(size.length() / 160), new MeshBasicMaterial());
    this.eye.far = size.length() * 1.45;
    this.scene.add(this.box, this.plan, this.real, this.tool);
  }

  showPlan(): void {
    this.plan.geometry.dispose();
    this.plan.geometry = geometry(planned.value);
    this.draw();
  }

  showDriven(): void {
    const points = driven.value;
    this.real.geometry.dispose();
    this.real.geometry = geometry(points.map((one) => one.place));
    const colours = new Float32Array(points.length * 3);
    const max = maxError.value;
    points.forEach((one, i) =>
      colours.set(
        errorColour(one.error / max, dark.value).map((c) => (c / 255) ** 2.2),
        i * 3,
      ),
    );
    this.real.geometry.setAttribute('color', new BufferAttribute(colours, 3));
    this.draw();
  }

  showTool(): void {
    state.axes.value.slice(0, 3).forEach((axis, i) => this.tool.position.setComponent(i, axis.actual));
    this.draw();
  }

  showTheme(): void {
    const style = getComputedStyle(this.canvas);
    const get = (name: string): string => style.getPropertyValue(name).trim();
    void dark.value;
    this.box.material.color.set(get('--muted'));
    this.plan.material.color.set(get('--plan'));
    this.tool.material.color.set(get('--amber'));
    this.draw();
  }

  draw(): void {
    if (this.wanted) return;
    this.wanted = true;
    requestAnimationFrame(() => {
      this.wanted = false;
      const { clientWidth: width, clientHeight: height } = this.canvas;
      if (width === 0) return;
      this.renderer.setPixelRatio(devicePixelRatio || 1);
      this.renderer.setSize(width, height, false);
      this.camera.aspect = width / height;
      this.camera.up.set(0, 0, 1);
      const { turn, tilt, far } = this.eye;
      this.camera.position
        .set(Math.cos(turn) * Math.cos(tilt), Math.sin(turn) * Math.cos(tilt), Math.sin(tilt))
        .multiplyScalar(far)
        .add(this.middle);
      this.camera.lookAt(this.middle);
      this.camera.updateProjectionMatrix();
      this.renderer.render(this.scene, this.camera);
    });
  }

  dispose(): void {
    this.renderer.dispose();
  }
}

/** The canvas follows the size of the panel. */
export function Space(): JSX.Element {
  const canvas = useRef<HTMLCanvasElement>(null);
  const view = useRef<View | null>(null);
  useEffect(() => {
    if (canvas.current === null) return undefined;
    const one = new View(canvas.current);
    view.current = one;
    const ends = [
      effect(() => one.showTheme()),
      effect(() => one.showPlan()),
      effect(() => one.showDriven()),
      effect(() => one.showTool()),
    ];
    const watch = new ResizeObserver(() => one.draw());
    watch.observe(canvas.current);
    return () => {
      ends.forEach((end) => end());
      watch.disconnect();
      one.dispose();
    };
  }, []);
  const turn = (by: Turn): void => {
    if (view.current === null) return;
    view.current.eye = turned(view.current.eye, by);
    view.current.draw();
  };
  const key = (event: KeyboardEvent): void => {
    const by = KEY_TURNS[event.key];
    if (by === undefined) return;
    event.preventDefault();
    turn(by);
  };
  const wheel = (event: WheelEvent): void => {
    event.preventDefault();
    turn({ far: event.deltaY > 0 ? 1.1 : 0.9 });
  };
  return (
    <canvas
      ref={canvas}
      class="flat space"
      role="img"
      tabIndex={0}
      aria-label="Path in space: travel, planned and driven line. Arrow keys rotate it, plus and minus zoom."
      onKeyDown={key}
      onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
      onPointerMove={(event) =>
        event.buttons === 1 && turn({ turn: -event.movementX / 150, tilt: event.movementY / 150 })
      }
      onWheel={wheel}
    />
  );
}
