# SPDX-License-Identifier: BSD-3-Clause
"""The add-on runs programs in the background, shows their progress, and stops them."""
import os
import shutil
import stat
import sys
import tempfile
import time
import unittest
from pathlib import Path
from unittest import mock

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parents[2] / 'blender' / 'local_barycentric_cage'))
import program  # noqa: E402
from program import Command, Job, Refusal  # noqa: E402


class ProgramTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def script(self, text):
        path = self.folder / 'flbc'
        path.write_text(f'#!/bin/sh\n{text}\n')
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return str(path)

    def run_one(self, text, names=()):
        def steps():
            self.reply = yield Command([self.script(text)], names)
        Job(steps()).run()
        return self.reply

    def test_a_result_needs_no_words(self):
        self.assertEqual(self.run_one('echo "flbc: few vertices" >&2; echo done >&2'), '')

    def test_a_result_that_has_not_converged_is_a_result(self):
        self.assertEqual(
            self.run_one('echo a >&2; echo "flbc: not converged; try --gap" >&2; exit 3'),
            'not converged. ')

    def test_a_failure_is_a_refusal_that_names_objects(self):
        with self.assertRaises(Refusal) as caught:
            self.run_one('echo "flbc: /tmp/cage.ply: a hole; try flbc cage --repair" >&2; exit 2',
                         {'/tmp/cage.ply': 'Horse Cage'})
        self.assertEqual(str(caught.exception), 'Horse Cage: a hole')

    def test_a_silent_failure_gives_the_status(self):
        with self.assertRaisesRegex(Refusal, 'status 5'):
            self.run_one('exit 5')

    def test_a_generator_may_wait_and_handle_failures(self):
        def steps():
            yield None
            with self.assertRaises(Refusal):
                yield Command([self.script('exit 2')])
            self.reply = 'handled'
        Job(steps()).run()
        self.assertEqual(self.reply, 'handled')

    def test_a_zip_may_contain_the_program(self):
        own = self.folder / 'flbc'
        own.write_text('#!/bin/sh\n')
        with mock.patch.object(program, 'OWN', str(own)):
            self.assertEqual(program.find(''), str(own))
            self.assertTrue(os.access(own, os.X_OK))
            self.assertEqual(program.find('sh'), shutil.which('sh'))

    def test_systems_without_terminals_have_messages(self):
        terminal, killpg = os.openpty, os.killpg
        del os.openpty, os.killpg
        try:
            self.assertEqual(
                self.run_one('echo "flbc: not converged" >&2; exit 3'), 'not converged. ')
        finally:
            os.openpty, os.killpg = terminal, killpg

    def test_progress_is_that_of_the_terminal(self):
        slow = self.script(r'test -t 2 && printf "\rsolving [##..] 40%%, 8 s left\033[K" >&2'
                           '\nsleep 60')

        def steps():
            yield Command([slow])
        job = Job(steps())
        while job.progress() != ('solving', 0.4):
            self.assertFalse(job.poll())
            time.sleep(0.01)
        job.cancel()

    def test_cancel_stops_the_program_and_its_children(self):
        mark = self.folder / 'pid'
        slow, ended = self.script(f'sleep 1000 & echo $! > {mark}; wait'), []

        def steps():
            try:
                yield Command([slow])
            finally:
                ended.append(True)
        job = Job(steps())
        job.poll()
        while not (mark.exists() and mark.read_text().strip()):
            time.sleep(0.01)
        job.cancel()
        self.assertEqual(ended, [True])
        child = int(mark.read_text())
        while Path(f'/proc/{child}').exists():  # for ever, if it was not stopped
            if 'Z' in Path(f'/proc/{child}/stat').read_text().split(')')[1][:3]:
                break
            time.sleep(0.01)

    def test_the_program_is_that_of_the_preferences_or_of_the_search_path(self):
        path, before = self.script('exit 0'), os.environ['PATH']
        self.addCleanup(os.environ.__setitem__, 'PATH', before)
        self.assertEqual(program.find(path), path)
        os.environ['PATH'] = str(self.folder)
        self.assertEqual(program.find(''), path)
        os.environ['PATH'] = '/nowhere'
        with self.assertRaisesRegex(Refusal, 'missing'):
            program.find('')
        with self.assertRaisesRegex(Refusal, '/nowhere/flbc is not a program'):
            program.find('/nowhere/flbc')

    def test_all_files_of_the_addon_are_python(self):
        for path in Path(program.__file__).parent.glob('*.py'):
            compile(path.read_text(), str(path), 'exec')


if __name__ == '__main__':
    unittest.main()
