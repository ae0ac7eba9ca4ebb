// The worked example in eight steps. A step may edit the scene or the options; Back undoes no edit.

export const STEPS = [
  {text: "This is a scene: a camera in four lines, then one triangle, turned by 90 degrees and moved by 1. The page runs the real tools, compiled for the browser: nothing leaves your computer.",
    sample: "worked-example"},
  {text: "model carries out the transforms and writes world space: see its text below, line by line, and the wireframe at the top left. Point at the triangle; it is marked everywhere."},
  {text: "view moves the world so that the eye is at the origin and looks down -z. Every z has become smaller by 2: that is where the eye was."},
  {text: "project divides by the distance. Everything in view now lies between -1 and 1, and a smaller z is nearer."},
  {text: "zbuf draws pixels: each shows the nearest triangle. Click a pixel of the image to see its depth and every fragment that competed for it."},
  {text: "Let us move the camera: the eye, in line 2 of the scene, is now 1 1 3. All stages have run again.", edit: text => text.replace("0 0 2 ", "1 1 3 ")},
  {text: "And now it looks the wrong way: the point looked at, in line 3, is 1 1 6. The picture is black, and the message says why. Mend it.", edit: text => text.replace("0 0 0 ", "1 1 6 ")},
  {text: "Ctrl+Z takes back edits, including this tour's. Save writes everything to a file: scene, config, options and your own stages. Send it to someone, or choose a larger sample and look into it."},
];
