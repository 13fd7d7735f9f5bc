using System;
using System.IO;
using System.Threading;
using Collektive.Unity.Editor;
using UnityEditor.Headless;

namespace Collektive.Headless.TwoEditors
{
    /// <summary>
    /// One of several editors of one project, which is the current folder: in each round it waits for the file <c>round-N</c>, copies the package's flatc to
    /// where it may be executed, and runs it. Argument: the number of rounds. Exit code 1 with the error.
    /// </summary>
    internal static class Program
    {
        private static int Main(string[] arguments)
        {
            try
            {
                Menus.Load();
                for (var round = 0; round < int.Parse(arguments[0]); round++)
                {
                    while (!File.Exists("round-" + round)) Thread.Sleep(1);
                    ToolRun.Do(Toolchain.Flatc(), "--version");
                    Console.WriteLine("round " + round);
                }
                return 0;
            }
            catch (Exception error)
            {
                Console.WriteLine(error);
                return 1;
            }
        }
    }
}
