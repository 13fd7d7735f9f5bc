using System;
using System.IO;
using System.Threading;
using Collektive.Unity.Editor;
using UnityEditor.Headless;

namespace Collektive.Headless.TwoEditors
{
    /// <summary>
    /// Acts as one of several editors of the project in the current folder. In each round it waits for the file <c>round-N</c>, copies the package's flatc
    /// to an executable place, and runs it. Argument: the number of rounds. On an error, prints it and exits with code 1.
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
