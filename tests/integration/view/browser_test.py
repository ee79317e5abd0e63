#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""usage: browser_test.py PHAROS LCM_GEN [SCREENSHOT]

`pharos view` in a real Chromium with software rendering: the page is drawn, a pose moves its target, a source that stops
turns its light red, foreign messages are counted, a camera's picture is shown and marked when it is old, dark and light differ, a phone's width needs no sideways scrolling, a
replay jumps. 77 (skipped) without Chromium."""

import base64
import json
import pathlib
import struct
import sys
import tempfile
import threading
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "tools/lib"))
from browser import Browser, chromium
from running_view import RunningView, load_types, pose, preview, target_state

PROGRAM, LCM_GEN = sys.argv[1:3]
SCREENSHOT = sys.argv[3] if len(sys.argv) > 3 else None
ROWS = "document.querySelectorAll('#rows tr[data-id]').length"


class Sender(threading.Thread):
    """Sends two targets' poses thirty times a second; where each is can be set, None is silence."""

    def __init__(self, view, types):
        super().__init__(daemon=True)
        self.view, self.types = view, types
        self.places = {"dock": (0.3, 0.1, 2.0), "client": (-0.4, 0.0, 3.0)}
        self.running = True

    def run(self):
        sequence = 0
        while self.running:
            for target, place in list(self.places.items()):
                if place:
                    self.view.publish("PHAROS_LIGHTHOUSE_POSE", pose(self.types, target, place, sequence))
            self.view.publish("PHAROS_LIGHTHOUSE_POSE", b"garbage")
            sequence += 1
            time.sleep(1 / 30)


def scene_place(target):
    """Where the scene draws a target, [x, y, z] in its world; null where it does not."""
    return f"""(() => {{
      const id = [...pharosScene.targets.keys()].find((key) => key.includes('|{target}|'));
      const place = id && pharosScene.place(id);
      return place ? JSON.stringify([place.x, place.y, place.z]) : null; }})()"""


def lamp(target, number):
    return f"""document.querySelector("#rows tr[data-id*='|{target}|']").querySelectorAll('.lamp')[{number}].className"""


class ViewInChromium(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.types = load_types(LCM_GEN)
        cls.view = RunningView(PROGRAM)
        cls.sender = Sender(cls.view, cls.types)
        cls.sender.start()
        cls.browser = Browser(cls.view.address)
        cls.browser.wait_for(f"{ROWS} === 2 && window.pharosScene !== undefined")

    @classmethod
    def tearDownClass(cls):
        cls.sender.running = False
        cls.sender.join()
        cls.browser.close()
        cls.view.close()

    def place(self, target):
        text = self.browser.evaluate(scene_place(target))
        return text and json.loads(text)

    def test_1_the_page_is_drawn_without_an_error(self):
        self.assertEqual(self.browser.evaluate(ROWS), 2)
        self.assertTrue(self.browser.wait_for("document.getElementById('link').textContent === 'live'"))
        self.assertTrue(self.browser.evaluate("document.getElementById('no-scene').hidden"), "there is a scene")
        self.assertEqual(self.browser.exceptions(), [])
        self.browser.screenshot(SCREENSHOT)
        paint = self.browser.evaluate("performance.getEntriesByName('first-contentful-paint')[0].startTime")
        print(f"first contentful paint after {paint:.0f} ms")
        frames = self.browser.evaluate("pharosFigures.frames")
        time.sleep(3)
        print(f"{(self.browser.evaluate('pharosFigures.frames') - frames) / 3:.0f} frames/s")

    def test_2_a_pose_moves_its_target(self):
        before = self.place("dock")
        self.sender.places["dock"] = (-0.6, 0.4, 2.5)
        self.assertTrue(self.browser.wait_for(f"""(() => {{ const place = {scene_place('dock')};
            return place && Math.abs(JSON.parse(place)[0] - {before[0]} + 0.9) < 1e-3; }})()"""), "0.9 m to the left")
        after = self.place("dock")
        self.assertAlmostEqual(after[1] - before[1], -0.3, 3, "y down is y up in the scene")
        self.assertAlmostEqual(after[2] - before[2], -0.5, 3, "z ahead is away from the viewer")
        self.assertTrue(self.browser.wait_for("document.getElementById('rows').textContent.includes('2.602 m')"), "range")

    def test_3_the_scene_shows_where_the_target_is(self):
        """Pixels: the scene changes between two places, and less while nothing moves."""
        def pixels():
            return self.browser.evaluate("""(() => { const scene = pharosScene; scene.stale = true; scene.cost_ms = 0; scene.draw(null);
              const gl = scene.renderer.getContext(); const w = scene.canvas.width, h = scene.canvas.height;
              const data = new Uint8Array(4 * w * h); gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, data);
              return Array.from(data.filter((_, at) => at % 64 === 0)); })()""")
        def differing(a, b):
            return sum(abs(x - y) > 16 for x, y in zip(a, b))
        self.sender.places["client"] = (-0.4, 0.0, 3.0)
        time.sleep(1)
        still = pixels()
        time.sleep(1)
        at_rest = differing(still, pixels())
        self.sender.places["client"] = (0.8, -0.5, 1.5)
        self.browser.wait_for(f"(() => {{ const p = {scene_place('client')}; return p && JSON.parse(p)[2] > -1.6; }})()")
        moved = differing(still, pixels())
        self.assertGreater(len(set(still)), 20, "the scene is not empty")
        self.assertGreater(moved, 2 * at_rest + 10)

    def test_4_a_source_that_stops_turns_its_light_red_and_is_lost(self):
        self.assertTrue(self.browser.wait_for(f"{lamp('dock', 3)} === 'lamp good'"))
        self.sender.places["dock"] = None
        self.assertTrue(self.browser.wait_for(f"{lamp('dock', 0)} === 'lamp bad' && {lamp('dock', 3)} === 'lamp bad'"))
        self.assertTrue(self.browser.wait_for("document.getElementById('rows').textContent.includes('no message for')"))
        self.assertTrue(self.browser.wait_for("document.getElementById('event-list').textContent.includes('LOST')"))
        self.assertEqual(self.browser.evaluate(lamp("client", 3)), "lamp good", "the other one goes on")
        self.assertIsNone(self.place("dock"), "it is no longer drawn")
        self.sender.places["dock"] = (0.3, 0.1, 2.0)
        self.assertTrue(self.browser.wait_for(f"{lamp('dock', 3)} === 'lamp good'"))
        self.assertTrue(self.browser.wait_for("document.getElementById('event-list').textContent.includes('FOUND')"))

    def test_5_foreign_messages_are_counted_and_shown(self):
        self.assertTrue(self.browser.wait_for("/[1-9]\\d* of other types skipped/.test(document.getElementById('counters').textContent)"))

    def test_5b_a_fused_state_has_its_row_its_place_and_its_level(self):
        fused = "document.getElementById('fused').textContent"
        self.assertIn("no fused state", self.browser.evaluate(fused))
        for sequence in range(3):
            self.view.publish("PHAROS_TARGET_STATE", target_state(self.sender.types, "client", (0.1, -0.2, 2.5), sequence))
            time.sleep(0.1)
        self.assertTrue(self.browser.wait_for(f"{fused}.includes('fused: fused')"))
        self.assertTrue(self.browser.evaluate("document.getElementById('no-fused').hidden"))
        self.assertEqual(self.browser.evaluate(ROWS), 2, "sources have their own rows")
        level = """(() => { const target = [...pharosScene.targets].find(([id]) => id.includes('TARGET_STATE'))?.[1];
            return target && target.protection.visible ? [target.protection.scale.x, ...target.protection.position.toArray()].join() : null; })()"""
        self.assertTrue(self.browser.wait_for(f"{level} === '0.25,0.1,-0.2,2.5'"), self.browser.evaluate(level))
        self.assertTrue(self.browser.wait_for(f"{fused}.includes('no message for')"), "it stopped")
        self.assertFalse(self.browser.evaluate(f"{level} !== null"))
        self.assertEqual(self.browser.exceptions(), [])

    def test_5c_a_picture_is_shown_as_it_came_and_marked_when_it_is_old(self):
        self.assertTrue(self.browser.evaluate("document.getElementById('cameras').hidden"), "no camera, no pane")
        made = self.browser.evaluate("""(() => { const canvas = document.createElement('canvas'); canvas.width = 160; canvas.height = 120;
            const pen = canvas.getContext('2d'); pen.fillStyle = '#f00'; pen.fillRect(0, 0, 80, 120); pen.fillStyle = '#00f'; pen.fillRect(80, 0, 80, 120);
            return canvas.toDataURL('image/jpeg', 0.9); })()""")
        jpeg = base64.b64decode(made.split(",")[1])
        for sequence in range(4):
            self.view.publish("PHAROS_PREVIEW", preview(self.types, "tof/helios", jpeg, sequence))
            time.sleep(0.2)
        image = "document.querySelector('#cameras .camera img')"
        self.assertTrue(self.browser.wait_for(f"{image}?.naturalWidth === 160 && {image}.complete"))
        colours = f"""(() => {{ const canvas = document.createElement('canvas'); canvas.width = 160; canvas.height = 120;
            const pen = canvas.getContext('2d'); pen.drawImage({image}, 0, 0);
            return JSON.stringify([...pen.getImageData(40, 60, 1, 1).data, ...pen.getImageData(120, 60, 1, 1).data]); }})()"""
        asked = "[255, 0, 0, 255, 0, 0, 255, 255]"
        # Nothing is drawn while the next picture loads.
        self.assertTrue(self.browser.wait_for(f"JSON.parse({colours}).every((value, at) => Math.abs(value - {asked}[at]) < 9)"),
                        self.browser.evaluate(colours))
        caption = "document.querySelector('#cameras figcaption').textContent"
        self.assertTrue(self.browser.wait_for(f"{caption}.startsWith('tof/helios: ')"))
        self.browser.evaluate("document.querySelector('#cameras .camera').click()")
        self.view.publish("PHAROS_PREVIEW", preview(self.types, "tof/helios", jpeg, 4))
        self.assertTrue(self.browser.wait_for("document.querySelector('#picture img').naturalWidth === 160"), "large")
        self.browser.evaluate("document.getElementById('picture').close()")
        self.assertTrue(self.browser.wait_for(f"document.querySelector('#cameras .camera.stale') !== null && {caption}.includes('old')"), "it stopped")
        self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), 1280)
        self.assertEqual(self.browser.exceptions(), [])

    def test_6_keys_work_and_dark_and_light_differ(self):
        def press(key):
            self.browser.evaluate(f"document.body.dispatchEvent(new KeyboardEvent('keydown', {{key: {json.dumps(key)}, bubbles: true}}))")
        background = "getComputedStyle(document.body).backgroundColor"
        dark = self.browser.evaluate(background)
        press("t")
        self.assertNotEqual(self.browser.evaluate(background), dark)
        press("ArrowDown")
        self.assertTrue(self.browser.wait_for("document.querySelector('#rows tr.selected td.target').textContent === 'dock'"))
        press("?")
        self.assertTrue(self.browser.evaluate("document.getElementById('help').open"))

    def test_7_a_phone_scrolls_down_but_not_sideways(self):
        phone = Browser(self.view.address, 390, 844, theme="light")
        try:
            self.assertTrue(phone.wait_for(f"{ROWS} === 2"))
            self.assertLessEqual(phone.evaluate("document.documentElement.scrollWidth"), 390)
            self.assertEqual(phone.exceptions(), [])
        finally:
            phone.close()


class ReplayInChromium(unittest.TestCase):
    def test_the_slider_jumps(self):
        types = load_types(LCM_GEN)
        with tempfile.NamedTemporaryFile(suffix=".lcm") as log:
            for k in range(300):
                channel = b"PHAROS_LIGHTHOUSE_POSE"
                content = pose(types, "dock", (0, 0, 1 + 0.01 * k), k).encode()
                log.write(struct.pack(">IqqII", 0xEDA1DA01, k, 1_700_000_000_000_000 + k * 100_000, len(channel), len(content)))
                log.write(channel + content)
            log.flush()
            view = RunningView(PROGRAM, "--log", log.name)
            browser = Browser(view.address)
            try:
                self.assertTrue(browser.wait_for("!document.getElementById('replay').hidden"))
                browser.evaluate("document.getElementById('play').click()")
                browser.evaluate("(() => { const s = document.getElementById('slider'); s.value = 20; s.dispatchEvent(new Event('change')); })()")
                self.assertTrue(browser.wait_for("document.getElementById('rows').textContent.includes('3.000 m')"), "at 20 s")
                self.assertTrue(browser.wait_for("document.getElementById('replay-time').textContent.startsWith('0:00:20')"))
                self.assertEqual(browser.exceptions(), [])
            finally:
                browser.close()
                view.close()


if __name__ == "__main__":
    if chromium() is None:
        print("skipped: Chromium is not installed (tools/install-dependencies full)")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=2)
